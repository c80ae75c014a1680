// Visual odometry of one camera that somebody wears: ORB features, a start from two views, a map of key frames and
// points that grows with the way and is adjusted as it grows, and every picture's pose against it (paper 001 section
// 2.2, whose scheme is ORB-SLAM's: Mur-Artal 2015). No loop is closed and no place is known again: what it tells
// drifts. When too little of the map is found for a while the way is lost, and said to be; then all begins anew, with
// another origin and another scale, in the next segment.
#pragma once

#include "drivers/camera/odometry/camera_pose.h"
#include "drivers/camera/picture.h"
#include "fusion/option.h"
#include "fusion/vision/lens.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>

namespace locus::camera {

struct OdometerSettings {
    std::uint32_t features = 1000; ///< Mur-Artal 2015, section V-A, for pictures of 512 x 384 to 752 x 480
    std::uint32_t key_frames = 100;
    double lost_after_s = 0.5;
};

inline constexpr std::array odometer_options{
    option<&OdometerSettings::features>("features", "", 200, 5000, "Corners that are looked for in a picture."),
    option<&OdometerSettings::key_frames>("key_frames", "", 10, 1000,
                                          "Pictures that its map is made of; the oldest are forgotten."),
    option<&OdometerSettings::lost_after_s>("lost_after_s", "s", 0, 10,
                                            "After so long without a pose the way counts as lost, and a new one "
                                            "begins."),
};

enum class OdometerState : std::uint8_t { starting, tracking, lost };

/// What one picture says.
struct OdometerReading {
    OdometerState state = OdometerState::starting; ///< lost: until the next way has begun
    std::uint32_t segment = 0;                     ///< of which way the pose is; one origin and one scale each
    std::optional<CameraPose> pose;                ///< against the segment's map; empty: this picture does not tell
    std::size_t points = 0;                        ///< of the map that were seen
};

class VisualOdometer {
  public:
    /// `lens`: of pictures of this size. `first_segment`: number of the first way.
    VisualOdometer(const OdometerSettings& settings, const vision::Lens& lens, const Eigen::Vector2i& size_px,
                   std::uint32_t first_segment = 1);
    ~VisualOdometer();

    /// Pictures come in order of time, all of the one size. The map's axes are the camera's at the segment's first
    /// picture; its unit is about the distance of what was seen then. cv::Exception where OpenCV fails.
    OdometerReading look(const Picture& picture, Timestamp captured);

  private:
    class Way;
    std::unique_ptr<Way> way_;
};

} // namespace locus::camera
