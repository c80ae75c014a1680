// People in the frames of one camera: found by a detector, followed by a tracker, put on the floor where the camera is
// calibrated. All that lies between a frame and its foot points.
#pragma once

#include "drivers/camera/detector.h"
#include "drivers/camera/picture.h"
#include "fusion/measurement.h"
#include "fusion/vision/tracker.h"

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace locus::camera {

/// How high somebody of that height is in the image who stands there: what detectors want to know of a calibration.
/// Empty for a homography, which knows of the floor only.
ExpectedHeight expected_height(const std::optional<vision::FloorView>& floor, const vision::BodyHeight& body);

struct PeopleParts {
    std::unique_ptr<Detector> detector{};
    vision::TrackerSettings tracker{};
    std::optional<vision::FloorView> floor{}; ///< for frames of this size; empty: not calibrated
    vision::BodyHeight body{};
    std::uint32_t first_track = 1; ///< number of the first person
};

class People {
  public:
    explicit People(PeopleParts parts);

    /// The tracks after this frame. Frames come in order of time.
    std::span<const vision::ImageTrack> look(const Frame& frame);

    /// Where those stand that were seen in the last frame. None without a calibration.
    std::span<const FootPoint> feet(Address camera);

  private:
    PeopleParts parts_;
    vision::Tracker tracker_;
    std::span<const vision::ImageTrack> tracks_;
    std::vector<FootPoint> feet_;
};

} // namespace locus::camera
