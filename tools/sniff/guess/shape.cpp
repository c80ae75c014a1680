#include "tools/sniff/guess/shape.h"

#include <algorithm>
#include <array>

namespace locus::sniff {
namespace {

/// The most frequent of what `byte_of` gives for each frame, when at least 19 in 20 have it.
template <class ByteOf>
std::optional<std::uint8_t> common(const std::vector<Cut>& frames, const ByteOf& byte_of) {
    std::array<std::size_t, 256> counts{};
    std::size_t all = 0;
    for (const Cut& cut : frames)
        if (const std::optional<std::uint8_t> byte = byte_of(cut)) ++counts[*byte], ++all;
    const auto most = std::ranges::max_element(counts);
    if (all == 0 || *most * 20 < all * 19) return std::nullopt;
    return static_cast<std::uint8_t>(most - counts.begin());
}

} // namespace

std::optional<std::uint8_t> common_byte(wire::Bytes bytes, const std::vector<Cut>& frames, std::ptrdiff_t place) {
    return common(frames, [&](const Cut& cut) -> std::optional<std::uint8_t> {
        const auto at = static_cast<std::ptrdiff_t>(cut.begin) + place;
        if (at < 0 || at >= std::ssize(bytes)) return std::nullopt;
        return bytes[static_cast<std::size_t>(at)];
    });
}

std::optional<std::uint8_t> common_last_byte(wire::Bytes bytes, const std::vector<Cut>& frames, std::size_t place) {
    return common(frames, [&](const Cut& cut) -> std::optional<std::uint8_t> {
        if (place >= cut.length) return std::nullopt;
        return bytes[cut.begin + cut.length - 1 - place];
    });
}

std::vector<Cut> moved(const std::vector<Cut>& frames, std::ptrdiff_t earlier, std::size_t stream_bytes) {
    std::vector<Cut> result;
    for (const Cut& cut : frames) {
        const std::ptrdiff_t begin = static_cast<std::ptrdiff_t>(cut.begin) - earlier;
        if (begin >= 0 && static_cast<std::size_t>(begin) + cut.length <= stream_bytes)
            result.push_back({static_cast<std::size_t>(begin), cut.length});
    }
    return result;
}

} // namespace locus::sniff
