// Poses of a SLAM or visual odometry of somebody else (ORB-SLAM3, OpenVINS, VINS-Fusion) as lines of text, in the
// format of the TUM RGB-D benchmark (Sturm 2012), which they all write or are easily made to:
//
//   1311868171.331406 0.0144578 0.0064183 -0.0057602 -0.0013450 -0.0102747 -0.0080008 0.9999143
//   time in seconds, camera's place x y z and attitude qx qy qz qw in the SLAM's frame, in the SLAM's unit of length
//
// Blanks, tabs or commas between the numbers. Empty lines and lines with '#' are passed over, but for two:
//
//   # lost          the SLAM lost its way: what comes next is a new segment
//   # segment 3     all that comes next lies in map 3, until another is named; the same again changes nothing
//
// There is no checksum: what does not fit the grammar is refused.
#pragma once

#include "drivers/decoder.h"

#include <optional>
#include <string>
#include <string_view>

namespace locus::slam {

struct TumPose {
    double time_s = 0; ///< of the SLAM's clock
    Vec3 position{};   ///< of the camera in the SLAM's frame and unit
    std::array<double, 4> orientation_xyzw{0, 0, 0, 1};

    bool operator==(const TumPose&) const = default;
};

/// Reads one line without its end; the numbers may be anything, also no numbers (nan).
std::optional<TumPose> parse_tum_pose(std::string_view line);

/// Whether time, place and attitude can be true: finite, and the quaternion of length 1.
bool is_usable(const TumPose& pose);

/// One line with "\n", as short as it can be without loss.
std::string encode(const TumPose& pose);

struct TumSettings {
    Address tag = no_address;
    Address camera = no_address;
    std::string stamps = "device";
    /// So long ORB-SLAM3 tries to find itself on its map before it begins another (Tracking.cc: 3 s, with an inertial
    /// sensor 5 s), and key frames of somebody who stands are as far apart (fr2_desk: 3.4 s).
    double gap_s = 5;
};

inline constexpr std::array<std::string_view, 2> tum_stamps{"device", "arrival"};

inline constexpr std::array tum_options{
    option<&TumSettings::tag>("tag",
                              "Address of the target that carries the camera; left out: the poses go to nobody."),
    option<&TumSettings::camera>("camera",
                                 "Address of the camera, of which `locus sources` tells; left out: that of the tag."),
    option<&TumSettings::stamps>("stamps",
                                 "What dates a pose: the line's own stamp, brought to the host's clock (device), or "
                                 "when the line came (arrival: its stamp is not looked at).",
                                 tum_stamps),
    option<&TumSettings::gap_s>("gap_s", "s", 0.1, 3600, "After so long without a pose the SLAM began a new segment."),
};

/// Gives a VisualOdometry a pose, with a segment of its own count.
std::unique_ptr<Decoder> make_tum(const void* settings);

} // namespace locus::slam
