#include "tools/sniff/contest.h"

#include "tools/sniff/guess/text.h"
#include "tools/sniff/settings_text.h"

#include <algorithm>
#include <random>
#include <tuple>

namespace locus::sniff {
namespace {

/// Of damaged frames, so many may still be taken by a format that guards them (a sum of 8 bits lets 1 in 256 pass; a
/// line of text that lost a digit for another is whole).
constexpr double most_leaking = 0.25;

/// Layouts wait for a description; what their defaults say is nothing.
bool can_be_tried(const DecoderRow& row) { return row.options.lists.empty(); }

/// The settings with each yes-or-no and each choice once other than it comes.
std::vector<std::shared_ptr<void>> variants(const DecoderRow& row) {
    std::vector<std::shared_ptr<void>> all;
    const auto defaults = row.options.make();
    const auto add = [&](const OptionRow& option, const OptionValue& value) {
        auto settings = row.options.make();
        option.set(settings.get(), value);
        if (!row.options.check || row.options.check(settings.get()).empty()) all.push_back(std::move(settings));
    };
    for (const OptionRow& option : row.options.rows) {
        const OptionValue value = option.get(defaults.get());
        if (const bool* yes = std::get_if<bool>(&value)) add(option, !*yes);
        for (const std::string_view choice : option.choices)
            if (value != OptionValue{std::string{choice}}) add(option, std::string{choice});
    }
    return all;
}

/// Two bytes in every frame's length replaced, in a CAN frame one.
Capture damaged(const Capture& capture, const Tally& understood) {
    std::mt19937 random{1};
    std::vector<std::uint8_t> bytes{capture.bytes().begin(), capture.bytes().end()};
    if (bytes.empty()) return capture;
    const bool can = capture.wire() == Wire::can;
    const std::size_t step = std::max<std::size_t>(understood.frame_bytes / (understood.frames * 2), 2);
    const auto spoil = [&](std::size_t at) { bytes[at] ^= static_cast<std::uint8_t>(1 + random() % 255); };
    for (std::size_t at = 0; !can && at < bytes.size(); at += step)
        spoil(std::min<std::size_t>(at + random() % step, bytes.size() - 1));
    std::size_t begin = 0;
    for (std::size_t i = 0; can && i < capture.packets(); ++i) {
        const std::size_t size = capture.at(i).data.size();
        if (size > 0) spoil(begin + random() % size);
        begin += size;
    }
    return capture.with_bytes(std::move(bytes));
}

Confidence confidence_of(const Standing& standing, Wire wire) {
    const Tally& tally = standing.tally;
    const bool clean = tally.all_refused() * 10 <= tally.frames;
    if (wire == Wire::can) {
        if (tally.all_measurements() == 0 || !clean) return Confidence::none;
        if (standing.guarded && tally.frames >= 3) return Confidence::sure;
        return tally.frames >= 10 ? Confidence::likely : Confidence::none;
    }
    // Another format may have most of the line (NMEA beside raw UBX).
    const bool beside = standing.share >= 0.05 && tally.frames >= 20 && tally.all_measurements() > 0;
    if (standing.guarded && (beside || (standing.share >= 0.25 && tally.frames >= 2)))
        return tally.frames >= 4 ? Confidence::sure : Confidence::likely;
    return tally.frames >= 4 && standing.share >= 0.7 ? Confidence::likely : Confidence::none;
}

/// Ends of lines belong to no frame.
std::size_t bytes_to_explain(const Capture& capture) {
    const auto bytes = capture.bytes();
    if (!is_text(bytes)) return bytes.size();
    return bytes.size() - static_cast<std::size_t>(
                              std::ranges::count_if(bytes, [](std::uint8_t b) { return b == '\r' || b == '\n'; }));
}

Standing standing_of(const Capture& capture, const DecoderRow& row, std::shared_ptr<void> settings, std::size_t bytes) {
    Standing standing{&row, std::move(settings), {}};
    standing.tally = tally_of(capture, row, standing.settings.get());
    const Tally& tally = standing.tally;
    if (tally.frames == 0) return standing;
    const bool can = row.wire == Wire::can;
    standing.share =
        can ? static_cast<double>(tally.frames) / static_cast<double>(capture.packets())
            : static_cast<double>(tally.frame_bytes) / static_cast<double>(std::max<std::size_t>(bytes, 1));
    standing.share = std::min(standing.share, 1.0);
    const Tally after = tally_of(damaged(capture, tally), row, standing.settings.get());
    // By bytes, because the damage is spread over them: where frames differ much in length, many short ones stay whole.
    const auto left = can ? after.frames : after.frame_bytes, before = can ? tally.frames : tally.frame_bytes;
    standing.guarded = static_cast<double>(left) <= most_leaking * static_cast<double>(before);
    standing.confidence = confidence_of(standing, row.wire);
    return standing;
}

bool is_better(const Standing& a, const Standing& b) {
    const auto rank = [](const Standing& s) {
        return std::tuple{s.confidence, s.tally.all_measurements() > 0, s.share, s.tally.all_measurements()};
    };
    return rank(a) > rank(b);
}

} // namespace

Tally tally_of(const Capture& capture, const DecoderRow& decoder, const void* settings) {
    const auto fresh = decoder.make(settings);
    TallySink sink;
    for (std::size_t i = 0; i < capture.packets(); ++i) fresh->decode(capture.at(i), sink);
    return sink.tally;
}

std::vector<Standing> contest(const Capture& capture) {
    std::vector<Standing> standings;
    const std::size_t bytes = bytes_to_explain(capture);
    const auto enter = [&](const DecoderRow& row, std::shared_ptr<void> settings) {
        Standing standing = standing_of(capture, row, std::move(settings), bytes);
        if (standing.tally.frames == 0) return;
        const auto place = std::ranges::upper_bound(standings, standing, is_better);
        standings.insert(place, std::move(standing));
    };
    const auto each_row = [&](const auto& enter_row) {
        for (const DecoderRow& row : decoder_table())
            if (row.wire == capture.wire() && can_be_tried(row)) enter_row(row);
    };
    each_row([&](const DecoderRow& row) { enter(row, row.options.make()); });
    if (!winners(standings).empty() || capture.empty()) return standings;
    standings.clear();
    each_row([&](const DecoderRow& row) {
        enter(row, row.options.make());
        for (auto& settings : variants(row)) {
            const Tally tally = tally_of(capture, row, settings.get()); // a loose setting finds frames in anything
            if (tally.all_measurements() > 0) enter(row, std::move(settings));
        }
    });
    // Settings that change nothing for these bytes are not worth a line: the best of a decoder stands for it.
    std::vector<Standing> best;
    for (Standing& standing : standings)
        if (std::ranges::find(best, standing.decoder, &Standing::decoder) == best.end())
            best.push_back(std::move(standing));
    return best;
}

std::vector<Standing> winners(const std::vector<Standing>& standings) {
    std::vector<Standing> found;
    for (const Standing& standing : standings) {
        if (standing.confidence == Confidence::none) continue;
        // Beside one that gives measurements, one that gives none is only a looser reading of the same bytes.
        const bool says_less = !found.empty() && standing.tally.all_measurements() == 0;
        if (!says_less) found.push_back(standing);
    }
    return found;
}

} // namespace locus::sniff
