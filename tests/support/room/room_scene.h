// A furnished room with random texture, and the grey pictures that a pinhole camera in it takes: one ray a pixel, to
// walls, floor, ceiling and boxes that hide each other. The textures are made coarser with the distance, as a lens
// does.
#pragma once

#include "fusion/vision/lens.h"

#include <Eigen/Geometry>
#include <opencv2/core.hpp>

#include <vector>

namespace locus::room {

/// Camera axes: x to the right, y down, z forward. Room: z up, metres.
struct RoomView {
    Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
    Eigen::Quaterniond room_from_camera = Eigen::Quaterniond::Identity();
};

class RoomScene {
  public:
    static constexpr int width_px = 640, height_px = 480;
    /// 70 degrees across, as cameras that are worn have at least.
    static constexpr double focal_px = 457;

    /// From its lower corner at (0, 0, 0) to `size_m`. `contrast`: 1 is a lively room, 0.3 a bare one.
    RoomScene(unsigned seed, const Eigen::Vector3d& size_m, double contrast = 1);

    static vision::PinholeLens lens();

    /// Without noise or blur.
    cv::Mat picture(const RoomView& view) const;

  private:
    struct Box {
        Eigen::Array3f low, high;
        std::size_t texture = 0; ///< of its first face; each axis has its own
    };
    struct Hit {
        float distance = 0;
        int axis = 0; ///< across the face
        std::size_t texture = 0;
    };
    void furnish(cv::RNG& random);
    Hit nearest(const Eigen::Array3f& from, const Eigen::Array3f& one_over, const std::vector<const Box*>& near) const;
    float shade(const Hit& hit, const Eigen::Array3f& at, float pixel_m) const;

    Box room_;
    std::vector<Box> furniture_;
    std::vector<std::vector<cv::Mat>> textures_; ///< each from fine to coarse, every one half as fine as the one before
};

} // namespace locus::room
