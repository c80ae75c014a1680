// Points of the map looked up in a picture where a guessed pose says they should be.
#pragma once

#include "drivers/camera/odometry/feature_grid.h"
#include "drivers/camera/odometry/visual_map.h"

namespace locus::camera {

/// The ideal camera: no point beyond half a picture from the axis can be seen.
struct IdealCamera {
    double focal_px = 1;
    Eigen::Vector2d half_px{0, 0};
};

/// Where it should be seen and in which scale; empty where it cannot be.
struct Expectation {
    Eigen::Vector2d at_px;
    int octave = 0;
};
std::optional<Expectation> expect(const MapPoint& point, const CameraPose& pose, const IdealCamera& camera);

struct SearchSettings {
    double radius_px = 5; ///< in the finest scale; coarser ones are searched as much wider
    int most_different = 64;
};

/// Fills `points` (one for each feature) with those of `wanted` that are found and stand nowhere in it yet. What is
/// expected to be seen is put into `expected`.
void search_points(const VisualMap& map, const std::vector<PointId>& wanted, const CameraPose& pose,
                   const IdealCamera& camera, const Features& features, const FeatureGrid& grid,
                   const SearchSettings& settings, std::vector<PointId>& points, std::vector<PointId>& expected);

} // namespace locus::camera
