// Cameras that the tests of fusion/vision look through: one of each kind, four metres up a wall, looking down.
#pragma once

#include "fusion/vision/camera_model.h"

#include <vector>

namespace locus::vision_test {

/// Looks along +y of the site from `height_m` over the origin, `down_rad` below the horizontal.
inline vision::Camera looking_down(const vision::Lens& lens, double height_m = 4, double down_rad = 0.5) {
    const double s = std::sin(down_rad), c = std::cos(down_rad);
    vision::Camera camera;
    camera.lens = lens;
    camera.camera_from_site << 1, 0, 0, 0, -s, -c, 0, c, -s;
    camera.site_in_camera_m = -camera.camera_from_site * Eigen::Vector3d(0, 0, height_m);
    return camera;
}

inline vision::PinholeLens plain_pinhole() { return {{800, 800}, {640, 360}, {}, {}}; }

/// Distortions of the size that cheap wide lenses have; the fisheye sees beyond 90 degrees from its axis.
inline std::vector<vision::Lens> lenses() {
    return {plain_pinhole(),
            vision::PinholeLens{{700, 710}, {650, 350}, {-0.32, 0.12, -0.01, 0, 0, 0}, {1e-3, -5e-4}},
            vision::PinholeLens{{900, 905}, {630, 366}, {0.4, -0.1, 0.02, 0.7, -0.05, 0.01}, {-4e-4, 8e-4}},
            vision::FisheyeLens{{330, 332}, {645, 362}, {-0.02, 0.004, -0.002, 3e-4}},
            vision::TsaiLens{5.55, 5.1e-3, {4.69e-3, 4.65e-3}, {324, 283}},
            vision::TsaiLens{3.7, -1.2e-2, {4.65e-3, 4.65e-3}, {436, 258}}};
}

} // namespace locus::vision_test
