// The first view of the floor from a walk whose clock is off, among people who walk as well: for each time offset of a
// grid views are made from few feet of one or two tracks, and the one that explains most is kept (RANSAC, Fischler and
// Bolles 1981; costs as MLESAC, Torr and Zisserman 2000, eq. 12: a foot is the tagged person's, or anywhere in the
// image).
#pragma once

#include "fusion/vision/camera_model.h"
#include "fusion/vision/survey/floor_fit.h"
#include "fusion/vision/survey/tagged_path.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace locus::vision::survey {

/// Somebody's foot in an image.
struct SeenFoot {
    double time_s = 0; ///< of the camera's clock
    std::uint32_t track = 0;
    Eigen::Vector2d pixel_px{0, 0};
    double sigma_px = 1;
};

struct WalkSettings {
    double least_offset_s = -2; ///< what is added to the camera's time to have the poses'
    double most_offset_s = 2;
    double pose_sigma_m = 0.2; ///< of a pose, along each axis
    Eigen::Vector2d image_px{640, 480};
};

/// The pairs that feet are at an offset, with their indices; feet without a pose are left out.
struct Matched {
    std::vector<TimedPair> pairs;
    std::vector<std::size_t> feet;
};
Matched match(std::span<const SeenFoot> feet, const TaggedPath& path, double offset_s, double pose_sigma_m);

/// What a foot costs that is not the tagged person's.
double stranger_cost(const WalkSettings& settings);

/// Of the pairs, each at most that of a stranger, per foot; feet without a pose count as strangers.
double cost_of_view(const FloorView& view, const Matched& matched, std::size_t feet, const WalkSettings& settings);

struct WalkStart {
    FloorView view;
    double offset_s = 0;
    double cost = 0;
};

/// The best views at different offsets, the best first; empty where no offset has any. Seeded: the same for the same
/// feet.
std::vector<WalkStart> start_walk(std::span<const SeenFoot> feet, const TaggedPath& path,
                                  const std::optional<Lens>& lens, const WalkSettings& settings);

} // namespace locus::vision::survey
