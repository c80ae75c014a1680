#include "tools/sniff/guess/frames.h"

#include "drivers/layout/serial_format.h"
#include "tools/sniff/guess/checksums.h"
#include "tools/sniff/guess/shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <tuple>

namespace locus::sniff {
namespace {

using layout::SerialLayoutSettings;

constexpr std::size_t most_looked_at = 32768;
constexpr std::size_t most_framings = 12;
constexpr std::size_t most_turns = 16;
constexpr std::size_t longest_sync = 4, sync_with_checksum = 2;
constexpr std::size_t fewest_frames = 5, most_sample_frames = 200;

struct Rated {
    FrameGuess guess;
    std::size_t oddities = 0; ///< of two that find the same, the plainer one is it

    auto rank() const {
        return std::tuple{guess.layout.checksum != "none", guess.frames >= fewest_frames, guess.share,
                          -static_cast<std::ptrdiff_t>(oddities)};
    }
};

bool is_dull(std::uint8_t byte) { return byte == 0 || byte == 0xFF || byte == '\r' || byte == '\n'; }

std::string hex_of(const std::vector<std::uint8_t>& bytes) {
    std::string text;
    for (const std::uint8_t byte : bytes) text += fmt::format("{}{:02X}", text.empty() ? "" : " ", byte);
    return text;
}

/// The bytes that all frames begin with.
std::vector<std::uint8_t> common_begin(wire::Bytes bytes, const std::vector<Cut>& frames, std::size_t most) {
    std::vector<std::uint8_t> begin;
    while (begin.size() < most) {
        const auto byte = common_byte(bytes, frames, static_cast<std::ptrdiff_t>(begin.size()));
        if (!byte) break;
        begin.push_back(*byte);
    }
    return begin;
}

/// What a layout must have: a field. This one makes no measurement.
void put_placeholder(SerialLayoutSettings& layout, std::size_t shortest) {
    std::size_t at = layout::bytes_of_hex(layout.sync).value_or(std::vector<std::uint8_t>{}).size();
    if (layout.frame_bytes == 0)
        at = static_cast<std::size_t>(layout.length_at_byte) + static_cast<std::size_t>(layout.length_bytes);
    layout.fields = {{.quantity = "anchor", .at_byte = static_cast<int>(at < shortest ? at : 0)}};
}

SerialLayoutSettings layout_of(const LengthRule& rule, std::ptrdiff_t earlier) {
    SerialLayoutSettings layout;
    layout.frame_bytes = static_cast<int>(rule.fixed);
    if (rule.fixed > 0) return layout;
    layout.length_at_byte = static_cast<int>(static_cast<std::ptrdiff_t>(rule.at) + earlier);
    layout.length_bytes = static_cast<int>(rule.bytes);
    layout.length_byte_order = rule.big ? "big" : "little";
    layout.length_adds = rule.adds;
    return layout;
}

void put_tail(SerialLayoutSettings& layout, wire::Bytes bytes, const std::vector<Cut>& frames) {
    const auto last = common_last_byte(bytes, frames, 0), before = common_last_byte(bytes, frames, 1);
    if (last != '\n') return;
    layout.tail = before == '\r' ? "0D 0A" : "0A";
}

std::optional<Rated> rated(wire::Bytes bytes, const Framing& framing, std::ptrdiff_t earlier) {
    const auto frames = moved(framing.frames, earlier, bytes.size());
    if (frames.size() < fewest_frames - 1) return std::nullopt;
    SerialLayoutSettings layout = layout_of(framing.rule, earlier);
    const std::size_t room = layout.frame_bytes > 0 ? longest_sync : static_cast<std::size_t>(layout.length_at_byte);
    auto sync = common_begin(bytes, frames, std::min(longest_sync, room));
    if (sync.empty()) return std::nullopt;
    const std::size_t shortest = std::ranges::min(frames, {}, &Cut::length).length;
    const std::size_t run = sync.size();
    layout.sync = hex_of({sync.begin(), sync.begin() + static_cast<std::ptrdiff_t>(std::min(run, sync_with_checksum))});
    if (auto guarded = with_checksum(layout, bytes, frames)) {
        layout = *guarded;
    } else {
        if (run < 2) return std::nullopt;
        layout.sync = hex_of(sync);
        put_tail(layout, bytes, frames);
    }
    put_placeholder(layout, shortest);
    Rated result{measured(layout, bytes), 0};
    result.oddities = static_cast<std::size_t>(layout.checksum_trailer_bytes + layout.checksum_from_byte) +
                      (is_dull(sync[0]) ? 8 : 0) + (longest_sync - run);
    return result;
}

/// How much earlier than at its anchor a frame may begin: where a run of bytes begins that do not change, and for a
/// fixed length also everywhere that the same run may be the end of a frame and the begin of the next.
std::vector<std::ptrdiff_t> turns(wire::Bytes bytes, const Framing& framing) {
    std::vector<std::ptrdiff_t> earlier;
    const auto is_common = [&](std::ptrdiff_t place) { return common_byte(bytes, framing.frames, place).has_value(); };
    if (framing.rule.fixed == 0) {
        for (std::ptrdiff_t e = 0; e <= 3 && (e == 0 || is_common(-e)); ++e) earlier.push_back(e);
        return earlier;
    }
    const auto length = static_cast<std::ptrdiff_t>(framing.rule.fixed);
    std::ptrdiff_t run = 0;
    for (std::ptrdiff_t e = length - 1; e >= 0 && earlier.size() < most_turns; --e) {
        run = is_common(-e) ? run + 1 : 0;
        if (run >= 1 && run <= 3) earlier.push_back(e);
    }
    if (std::ranges::find(earlier, 0) == earlier.end()) earlier.push_back(0);
    return earlier;
}

std::vector<Framing> framings(wire::Bytes bytes) {
    std::vector<Framing> all; // the one that covers most first
    for (const Anchor& anchor : frequent_anchors(bytes))
        for (Framing& framing : guess_lengths(bytes, anchor))
            if (framing.frames.size() >= fewest_frames - 1 && framing.share > 0.3)
                all.insert(std::ranges::upper_bound(all, framing.share, std::greater{}, &Framing::share),
                           std::move(framing));
    std::vector<Framing> kept;
    for (const bool is_fixed : {true, false}) {
        std::size_t count = 0;
        for (Framing& framing : all)
            if ((framing.rule.fixed > 0) == is_fixed && count++ < most_framings) kept.push_back(std::move(framing));
    }
    return kept;
}

bool all_alike(const FrameGuess& guess) {
    return std::ranges::all_of(guess.samples, [&](const auto& frame) { return frame == guess.samples.front(); });
}

bool convinces(const FrameGuess& guess) {
    const double least_share = guess.layout.checksum == "none" ? 0.75 : 0.5;
    return guess.frames >= fewest_frames && guess.share >= least_share && !all_alike(guess);
}

} // namespace

FrameGuess measured(const SerialLayoutSettings& layout, wire::Bytes bytes) {
    FrameGuess guess;
    guess.layout = layout;
    std::size_t covered = 0;
    FrameStream<layout::SerialFormat> stream{layout::SerialFormat{layout}};
    Packet packet;
    packet.data = bytes;
    stream.feed(
        packet,
        [&](const Frame& frame) {
            guess.shortest = guess.frames++ == 0 ? frame.bytes.size() : std::min(guess.shortest, frame.bytes.size());
            guess.longest = std::max(guess.longest, frame.bytes.size());
            covered += frame.bytes.size();
            if (guess.samples.size() < most_sample_frames)
                guess.samples.emplace_back(frame.bytes.begin(), frame.bytes.end());
        },
        [](Refusal) {});
    guess.share = static_cast<double>(covered) / static_cast<double>(std::max<std::size_t>(bytes.size(), 1));
    return guess;
}

std::optional<FrameGuess> guess_frames(wire::Bytes bytes) {
    const wire::Bytes looked_at = bytes.first(std::min(bytes.size(), most_looked_at));
    std::optional<Rated> best;
    for (const Framing& framing : framings(looked_at))
        for (const std::ptrdiff_t earlier : turns(looked_at, framing))
            if (auto one = rated(looked_at, framing, earlier); one && (!best || one->rank() > best->rank()))
                best = std::move(one);
    if (!best || !convinces(best->guess)) return std::nullopt;
    return measured(best->guess.layout, bytes);
}

} // namespace locus::sniff
