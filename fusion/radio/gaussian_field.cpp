#include "fusion/radio/gaussian_field.h"

#include "fusion/radio/field_mixture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace locus::radio {
namespace {

/// Beacons heard at fewer points say nothing of how they fall off; in a map so small that is all there are.
constexpr std::size_t enough_points = 3;
constexpr double most_lost = 0.95;

FloorPoints corners_of(const FloorCells& cells) {
    FloorPoints corners(static_cast<Eigen::Index>(cells.count()), 2);
    for (Eigen::Index i = 0; i < corners.rows(); ++i) corners.row(i) = cells.place_site_m(static_cast<std::size_t>(i));
    return corners;
}

/// The most often heard, where there are more than memory is meant for.
std::vector<Address> beacons_for(const RadioMap& map) {
    std::vector<Address> beacons = beacons_of(map, std::min(enough_points, map.points.size()));
    for (std::size_t least = enough_points + 1; beacons.size() > max_beacons; ++least) beacons = beacons_of(map, least);
    return beacons;
}

bool is_near(const ReferencePoint& a, const ReferencePoint& b, double reach_m) {
    return std::hypot(a.position_site_m[0] - b.position_site_m[0], a.position_site_m[1] - b.position_site_m[1]) <=
           reach_m;
}

/// How often a beacon is missing at a point although it was heard near by: what a scan loses, by the map's own word.
/// Too much rather than too little: some of it lies at the rim of a beacon's reach.
double lost_by_map(const RadioMap& map, const std::vector<Address>& beacons) {
    std::size_t heard = 0, lost = 0;
    const double reach_m = hole_reach_m(map);
    const auto near_by = [&](const ReferencePoint& point, Address beacon) {
        return std::ranges::any_of(map.points, [&](const ReferencePoint& other) {
            return is_near(point, other, reach_m) && find(other, beacon) != nullptr;
        });
    };
    for (const Address beacon : beacons)
        for (const ReferencePoint& point : map.points) {
            if (find(point, beacon) != nullptr)
                ++heard;
            else if (near_by(point, beacon))
                ++lost;
        }
    return static_cast<double>(lost) / static_cast<double>(std::max<std::size_t>(1, lost + heard));
}

/// A survey goes where people go: the farther from its points, the less likely is anybody, by a bell of a few spacings.
void set_priors(const RadioMap& map, StrengthGrid& grid) {
    constexpr double prior_spacings = 3;
    const double reach_m = prior_spacings * point_spacing_m(map);
    for (std::size_t corner = 0; corner < grid.cells().count(); ++corner) {
        const Eigen::Vector2d place = grid.cells().place_site_m(corner);
        double nearest_m = std::numeric_limits<double>::infinity();
        for (const ReferencePoint& point : map.points)
            nearest_m = std::min(
                nearest_m, std::hypot(point.position_site_m[0] - place.x(), point.position_site_m[1] - place.y()));
        const double reaches = nearest_m / reach_m;
        grid.set_prior(corner, static_cast<float>(-0.5 * reaches * reaches));
    }
}

} // namespace

FloorCells cells_of(const RadioMap& map, std::size_t most_corners) {
    if (map.points.empty()) throw std::invalid_argument("a radio map without points says nothing");
    Eigen::Vector2d low(map.points[0].position_site_m[0], map.points[0].position_site_m[1]), high = low;
    for (const ReferencePoint& point : map.points) {
        const Eigen::Vector2d place(point.position_site_m[0], point.position_site_m[1]);
        low = low.cwiseMin(place);
        high = high.cwiseMax(place);
    }
    const double half_m = 0.5 * point_spacing_m(map);
    const Eigen::Vector2d margin_m = Eigen::Vector2d::Constant(half_m);
    return cells_over(low - margin_m, high + margin_m, half_m, most_corners);
}

StrengthGrid gaussian_field(const RadioMap& map, const FieldSettings& settings) {
    const FloorCells cells = cells_of(map, settings.most_corners);
    const std::vector<Address> beacons = beacons_for(map);
    if (beacons.empty()) throw std::invalid_argument("no beacon of the radio map was heard at three points or more");
    const FieldData data = field_data(map, beacons);
    const FloorPoints corners_m = corners_of(cells);
    Moments moments(corners_m.rows(), data.strengths_dbm.cols());
    for (const WeightedHypothesis& each : likely(data, point_spacing_m(map)))
        add_hypothesis(data, each, corners_m, moments);
    StrengthGrid grid(cells, beacons, hearing_floor_dbm(map));
    for (Eigen::Index b = 0; b < moments.mean.cols(); ++b)
        for (Eigen::Index c = 0; c < moments.mean.rows(); ++c) {
            const double mean = moments.mean(c, b) / moments.weight(c, b);
            const double variance = std::max(1.0, moments.square(c, b) / moments.weight(c, b) - mean * mean);
            grid.set(static_cast<std::size_t>(b), static_cast<std::size_t>(c),
                     {static_cast<float>(mean), static_cast<float>(variance)});
        }
    grid.finish(std::clamp(lost_by_map(map, beacons), settings.lost_share, most_lost));
    set_priors(map, grid);
    return grid;
}

} // namespace locus::radio
