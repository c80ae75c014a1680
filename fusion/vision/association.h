// Which detection is whose: the stages of DeepSORT and ByteTrack one after the other, each with what the last one left.
#pragma once

#include "fusion/vision/assignment.h"
#include "fusion/vision/camera_model.h"
#include "fusion/vision/track.h"

#include <span>
#include <vector>

namespace locus::vision {

/// Track -> detection, and the detections that nobody took.
struct Association {
    Pairing pairs;
    std::vector<std::size_t> strangers; ///< of the strong ones
};

/// Tracks are predicted to the time of the detections. `floor` may be null.
Association associate(std::span<const Track> tracks, std::span<const Detection> detections,
                      const TrackerSettings& settings, const FloorView* floor);

} // namespace locus::vision
