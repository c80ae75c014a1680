// POSE of docs/protocol.md.
#pragma once

#include "daemon/socket/names.h"
#include "fusion/pose.h"

#include <string>
#include <string_view>

namespace locus {

/// True when the pose may leave: there is a position, and it is finite.
bool is_publishable(const Pose& pose);

/// The POSE object of a publishable pose without its closing '}', so that a client's own `dropped` can follow.
/// `class_name` is SMOOTHED for one of smooth_lag_s ago. `reset_count` is the count that clients see: the estimate's
/// own starts at zero with each new configuration.
std::string open_pose_line(const Pose& pose, std::string_view target, std::uint32_t reset_count,
                           std::string_view class_name = "POSE");

/// The same with the camera track that the target is known by, all under their names.
std::string open_pose_line(const Pose& pose, const Names& names, std::uint32_t reset_count,
                           std::string_view class_name = "POSE");

} // namespace locus
