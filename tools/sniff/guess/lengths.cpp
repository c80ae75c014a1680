#include "tools/sniff/guess/lengths.h"

#include "drivers/layout/serial_layout.h"

#include <algorithm>
#include <array>
#include <set>

namespace locus::sniff {
namespace {

constexpr std::size_t anchors_ahead = 6; // so many false ones may stand in a frame
constexpr std::size_t farthest_number = 8;
constexpr std::size_t shortest_frame = 4;
constexpr int most_added = 64; // as serial_layout's length_adds
constexpr double least_support = 0.4;

std::optional<std::size_t> length_at(wire::Bytes bytes, std::size_t anchor, const LengthRule& rule) {
    if (rule.fixed > 0) return rule.fixed;
    if (anchor + rule.at + rule.bytes > bytes.size()) return std::nullopt;
    const auto said = rule.big ? wire::big_bytes(bytes, anchor + rule.at, rule.bytes)
                               : wire::little_bytes(bytes, anchor + rule.at, rule.bytes);
    const auto length = static_cast<std::int64_t>(said) + rule.adds;
    const bool possible = length >= static_cast<std::int64_t>(std::max(shortest_frame, rule.at + rule.bytes)) &&
                          length <= static_cast<std::int64_t>(layout::longest_serial_frame);
    return possible ? std::optional{static_cast<std::size_t>(length)} : std::nullopt;
}

/// Calls with the distance from each anchor to each of the next few.
template <class Each>
void each_distance(const std::vector<std::uint32_t>& at, const Each& each) {
    for (std::size_t i = 0; i < at.size(); ++i)
        for (std::size_t j = i + 1; j < at.size() && j <= i + anchors_ahead; ++j) each(at[i], at[j] - at[i]);
}

/// The most frequent distance, of multiples of it, which are nearly as frequent, the first; and the shortest that is
/// frequent enough, because frames with something between them are farther apart.
std::vector<LengthRule> fixed_rules(const std::vector<std::uint32_t>& at) {
    std::vector<std::uint32_t> counts(layout::longest_serial_frame + 1);
    each_distance(at, [&](std::uint32_t, std::uint32_t distance) {
        if (distance < counts.size()) ++counts[distance];
    });
    std::fill_n(counts.begin(), shortest_frame, 0u);
    const double most = *std::ranges::max_element(counts), least = least_support * static_cast<double>(at.size());
    if (most < least) return {};
    const auto first_above = [&](double limit) {
        const auto first = std::ranges::find_if(counts, [&](std::uint32_t count) { return count >= limit; });
        return static_cast<std::size_t>(first - counts.begin());
    };
    const std::size_t often = first_above(0.9 * most), shortest = first_above(least);
    if (often == shortest) return {{.fixed = often}};
    return {{.fixed = often}, {.fixed = shortest}};
}

/// What must be added to the number there so that it leads from most anchors to another one.
std::optional<LengthRule> said_rule(wire::Bytes bytes, const std::vector<std::uint32_t>& at, LengthRule rule) {
    std::array<std::uint32_t, 2 * most_added + 1> votes{};
    each_distance(at, [&](std::uint32_t anchor, std::uint32_t distance) {
        if (anchor + rule.at + rule.bytes > bytes.size()) return;
        const auto said = rule.big ? wire::big_bytes(bytes, anchor + rule.at, rule.bytes)
                                   : wire::little_bytes(bytes, anchor + rule.at, rule.bytes);
        const auto added = static_cast<std::int64_t>(distance) - static_cast<std::int64_t>(said);
        if (std::abs(added) <= most_added) ++votes[static_cast<std::size_t>(added + most_added)];
    });
    const auto best = std::ranges::max_element(votes);
    if (*best < least_support * static_cast<double>(at.size())) return std::nullopt;
    rule.adds = static_cast<int>(best - votes.begin()) - most_added;
    return rule;
}

Framing chain(wire::Bytes bytes, const std::vector<std::uint32_t>& at, const LengthRule& rule) {
    Framing framing{rule, {}, 0};
    std::size_t covered = 0, from = 0;
    for (const std::uint32_t anchor : at) {
        if (anchor < from) continue;
        const auto length = length_at(bytes, anchor, rule);
        if (!length) continue;
        const std::size_t end = anchor + *length;
        if (end != bytes.size() && !std::ranges::binary_search(at, end)) continue;
        framing.frames.push_back({anchor, *length});
        covered += *length;
        from = end;
    }
    // Where only the first anchors were kept, the stream is what they span.
    const std::size_t span = at.size() < 2
                                 ? bytes.size()
                                 : at.back() - at.front() + covered / std::max<std::size_t>(framing.frames.size(), 1);
    framing.share = static_cast<double>(covered) / static_cast<double>(std::max<std::size_t>(span, 1));
    return framing;
}

bool lengths_differ(const Framing& framing) {
    return std::ranges::any_of(framing.frames,
                               [&](const Cut& cut) { return cut.length != framing.frames.front().length; });
}

} // namespace

std::vector<Framing> guess_lengths(wire::Bytes bytes, const Anchor& anchor) {
    std::vector<Framing> found;
    for (const LengthRule& rule : fixed_rules(anchor.at)) found.push_back(chain(bytes, anchor.at, rule));
    for (std::size_t at = anchor.bytes.size(); at <= farthest_number; ++at)
        for (const auto& [size, big] : {std::pair{1, false}, {2, false}, {2, true}}) {
            const auto rule = said_rule(bytes, anchor.at, {0, at, static_cast<std::size_t>(size), big, 0});
            if (!rule) continue;
            Framing framing = chain(bytes, anchor.at, *rule);
            if (lengths_differ(framing)) found.push_back(std::move(framing)); // else a fixed length says the same
        }
    return found;
}

} // namespace locus::sniff
