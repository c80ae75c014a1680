// Nooploop LinkTrack over serial or USB, usually 921600 baud (NLink, protocols.md 2.2). What becomes of its frames:
//
//   anchorframe0  a Range from each tag it lists to anchors 0 to 7
//   tagframe0     a Range from the sender to anchors 0 to 7, and its IMU
//   nodeframe2    ranges from the sender to the units it lists, and its IMU
//   nodeframe3, nodeframe5, AOA frame   ranges from the sender to the units it lists
//   nodeframe4    a Range from each tag to the anchors listed with it (the sender is a console)
//   nodeframe0, 1 and 6, TOFSense       nothing that measures a tag
//
// In the frames of units that list others the roles tell which side is which: an anchor and a tag or node give a Range,
// two tags or nodes a PeerRange, any other pair nothing. The AOA frame's angle has no measurement yet; it is in
// nlink::RangesFrame. A distance of zero was not measured. Units without an IMU send zeros.
#pragma once

#include "drivers/decoder.h"

namespace locus::uwb {

struct NlinkSettings {
    int anchor_offset = 0;
    int tag_offset = 0;
};

inline constexpr std::array nlink_options{
    option<&NlinkSettings::anchor_offset>("anchor_offset", "", 0, 65535,
                                          "Added to the number of an anchor to make its address."),
    option<&NlinkSettings::tag_offset>("tag_offset", "", 0, 65535,
                                       "Added to the number of a tag or node to make its address."),
};

std::unique_ptr<Decoder> make_nlink(const void* settings);

} // namespace locus::uwb
