#include "tools/sniff/guess/anchors.h"

#include "drivers/layout/serial_layout.h"

#include <algorithm>
#include <utility>

namespace locus::sniff {
namespace {

constexpr std::size_t most_pairs = 160, most_places = 1024;
constexpr std::size_t fewest_places = 4;

using Frequencies = std::vector<std::uint32_t>;

Frequencies pair_counts(wire::Bytes bytes) {
    Frequencies counts(std::size_t{1} << 16);
    for (std::size_t i = 0; i + 1 < bytes.size(); ++i) ++counts[wire::big<std::uint16_t>(bytes, i)];
    return counts;
}

Frequencies byte_counts(wire::Bytes bytes) {
    Frequencies counts(256);
    for (const std::uint8_t byte : bytes) ++counts[byte];
    return counts;
}

/// The values that come often enough for frames that are not longer than a layout can have, the most frequent first.
std::vector<std::uint32_t> frequent(const Frequencies& counts, std::size_t bytes, std::size_t most) {
    const std::size_t least = std::max(fewest_places, bytes / layout::longest_serial_frame);
    std::vector<std::uint32_t> values;
    for (std::uint32_t value = 0; value < counts.size(); ++value)
        if (counts[value] >= least) values.push_back(value);
    std::ranges::sort(values, {}, [&](std::uint32_t value) { return std::pair{-std::int64_t{counts[value]}, value}; });
    values.resize(std::min(values.size(), most));
    return values;
}

Anchor found(wire::Bytes bytes, std::vector<std::uint8_t> wanted) {
    Anchor anchor{std::move(wanted), {}};
    auto from = bytes.begin();
    while (anchor.at.size() < most_places) {
        from = std::search(from, bytes.end(), anchor.bytes.begin(), anchor.bytes.end());
        if (from == bytes.end()) break;
        anchor.at.push_back(static_cast<std::uint32_t>(from++ - bytes.begin()));
    }
    return anchor;
}

} // namespace

std::vector<Anchor> frequent_anchors(wire::Bytes bytes) {
    std::vector<Anchor> anchors;
    for (const std::uint32_t pair : frequent(pair_counts(bytes), bytes.size(), most_pairs))
        anchors.push_back(found(bytes, {static_cast<std::uint8_t>(pair >> 8), static_cast<std::uint8_t>(pair)}));
    for (const std::uint32_t byte : frequent(byte_counts(bytes), bytes.size(), 256))
        anchors.push_back(found(bytes, {static_cast<std::uint8_t>(byte)}));
    return anchors;
}

} // namespace locus::sniff
