#include "drivers/uwb/nlink_messages.h"

#include "tests/examples/decoder_example.h"
#include "tests/examples/nlink_frames.h"

namespace locus::examples {

std::vector<DecoderExample> nlink() {
    DecoderExample summed{"nlink"};
    for (const auto frame : {nlink_frames::tag_frame0, nlink_frames::node_frame2, nlink_frames::node_frame3,
                             nlink_frames::node_frame4, nlink_frames::aoa_node_frame0})
        summed.chunks.push_back(from_hex(frame));
    for (std::uint8_t i = 0; i < 15; ++i) {
        uwb::nlink::RangesFrame ranges{
            uwb::nlink::Mark::node_frame5, {uwb::nlink::Role::tag, 0x10000u + i, 1, 2, 3}, {}, {}};
        ranges.nodes.push_back({uwb::nlink::Role::anchor, 7, 2000 + i, 0, 180, 160, 0});
        summed.chunks.push_back(encode(uwb::nlink::Message{ranges}));
    }
    DecoderExample constant{"nlink"}; // anchorframe0 ends in a constant
    constant.chunks.assign(4, from_hex(nlink_frames::anchor_frame0));
    constant.checksum = false;
    return {summed, constant};
}

} // namespace locus::examples
