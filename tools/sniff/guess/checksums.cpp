#include "tools/sniff/guess/checksums.h"

#include "drivers/layout/serial_format.h"

#include <algorithm>
#include <set>

namespace locus::sniff {
namespace {

constexpr std::size_t most_frames_tried = 40, frames_tried_first = 4;
constexpr std::size_t fewest_different = 5;
constexpr int last_begin = 5, longest_trailer = 2;

bool holds_on(const layout::SerialFormat& format, wire::Bytes frame) {
    const Look look = format.look(frame);
    return look.kind == Look::Kind::frame && look.length == frame.size();
}

/// A wrong one fails on the first frames already.
bool holds(const layout::SerialFormat& format, const std::vector<wire::Bytes>& frames) {
    const auto of = [&](std::size_t count) {
        return static_cast<std::size_t>(std::count_if(frames.begin(),
                                                      frames.begin() + static_cast<std::ptrdiff_t>(count),
                                                      [&](wire::Bytes frame) { return holds_on(format, frame); }));
    };
    return of(frames_tried_first) >= frames_tried_first - 1 && of(frames.size()) * 10 >= frames.size() * 9;
}

/// No frame twice: what repeats proves nothing.
std::vector<wire::Bytes> different(wire::Bytes bytes, const std::vector<Cut>& frames) {
    const auto before = [](wire::Bytes a, wire::Bytes b) { return std::ranges::lexicographical_compare(a, b); };
    std::set<wire::Bytes, decltype(before)> seen{before};
    std::vector<wire::Bytes> kept;
    for (const Cut& cut : frames)
        if (kept.size() < most_frames_tried && seen.insert(bytes.subspan(cut.begin, cut.length)).second)
            kept.push_back(bytes.subspan(cut.begin, cut.length));
    return kept;
}

} // namespace

std::optional<layout::SerialLayoutSettings> with_checksum(const layout::SerialLayoutSettings& layout, wire::Bytes bytes,
                                                          const std::vector<Cut>& frames) {
    const auto tried_on = different(bytes, frames);
    if (tried_on.size() < fewest_different) return std::nullopt;
    layout::SerialLayoutSettings tried = layout;
    for (tried.checksum_trailer_bytes = 0; tried.checksum_trailer_bytes <= longest_trailer;
         ++tried.checksum_trailer_bytes)
        for (tried.checksum_from_byte = 0; tried.checksum_from_byte <= last_begin; ++tried.checksum_from_byte)
            for (const std::string_view kind : layout::checksum_names)
                for (const std::string_view order : layout::serial_byte_orders) {
                    tried.checksum = kind;
                    tried.checksum_byte_order = order;
                    if (kind != "none" && holds(layout::SerialFormat{tried}, tried_on)) return tried;
                }
    return std::nullopt;
}

} // namespace locus::sniff
