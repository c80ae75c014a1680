#include "drivers/camera/odometry/two_view.h"

#include "drivers/camera/odometry/triangulate.h"
#include "drivers/camera/odometry/two_view_models.h"

#include <algorithm>
#include <numbers>

namespace locus::camera {
namespace {

/// Mur-Artal 2015, section IV: the homography's share of both scores from which on it is taken.
constexpr double flat_share = 0.45;
/// A point counts from here on, and half of the points must be seen under at least `median_parallax`.
constexpr double rad = std::numbers::pi / 180;
constexpr double least_parallax = 0.3 * rad, median_parallax = 1.5 * rad;
constexpr std::size_t least_points = 80;
/// The second best motion explains at most so much of what the best one does; the best at least so much of all.
constexpr double second_best = 0.75, least_share = 0.5;

std::vector<cv::Point2d> slopes(const Features& features, const std::vector<std::size_t>& which, double focal_px) {
    std::vector<cv::Point2d> points;
    for (const std::size_t i : which)
        points.emplace_back(features[i].at_px.x() / focal_px, features[i].at_px.y() / focal_px);
    return points;
}

TwoView explained(const Features& first, const Features& second, const std::vector<FeatureMatch>& matches,
                  const CameraPose& motion, double focal_px) {
    TwoView view{.second_from_first = motion, .points = {}};
    const CameraPose begin;
    for (const FeatureMatch& match : matches) {
        const auto point =
            triangulate({begin, first[match.first]}, {motion, second[match.second]}, focal_px, least_parallax);
        if (point.has_value()) view.points.emplace_back(match, point.value());
    }
    return view;
}

double median_parallax_of(const TwoView& view) {
    std::vector<double> angles;
    for (const auto& [match, point] : view.points)
        angles.push_back(parallax_rad(point, Eigen::Vector3d::Zero(), view.second_from_first.centre()));
    const auto middle = angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2);
    std::nth_element(angles.begin(), middle, angles.end());
    return *middle;
}

TwoViewModel chosen_model(const Features& first, const Features& second, const std::vector<FeatureMatch>& matches,
                          double focal_px, bool& is_flat) {
    std::vector<std::size_t> in_first, in_second;
    for (const auto& [a, b] : matches) {
        in_first.push_back(a);
        in_second.push_back(b);
    }
    const auto from = slopes(first, in_first, focal_px), to = slopes(second, in_second, focal_px);
    const TwoViewModel deep = essential_model(from, to, 1 / focal_px), flat = homography_model(from, to, 1 / focal_px);
    is_flat = flat.score > flat_share * (flat.score + deep.score);
    return is_flat ? flat : deep;
}

} // namespace

std::optional<TwoView> find_two_view(const Features& first, const Features& second,
                                     const std::vector<FeatureMatch>& matches, double focal_px) {
    if (matches.size() < least_points) return std::nullopt;
    bool is_flat = false;
    const TwoViewModel model = chosen_model(first, second, matches, focal_px, is_flat);
    TwoView best;
    std::size_t next_best = 0;
    for (const CameraPose& motion : model.motions) {
        TwoView view = explained(first, second, matches, motion, focal_px);
        next_best = std::max(next_best, std::min(view.points.size(), best.points.size()));
        if (view.points.size() > best.points.size()) best = std::move(view);
    }
    best.is_flat = is_flat;
    const auto count = static_cast<double>(best.points.size());
    const bool is_clear = best.points.size() >= least_points &&
                          count > least_share * static_cast<double>(matches.size()) &&
                          static_cast<double>(next_best) < second_best * count;
    if (!is_clear || median_parallax_of(best) < median_parallax) return std::nullopt;
    return best;
}

} // namespace locus::camera
