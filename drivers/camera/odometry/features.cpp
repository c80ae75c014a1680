#include "drivers/camera/odometry/features.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cstring>
#include <set>
#include <utility>

namespace locus::camera {
namespace {

/// ORB's own corner threshold; bare walls have only weak corners, and the strongest of a cell are kept anyway
/// (Mur-Artal 2015, section V-A, lowers it there as well).
constexpr int corner_threshold = 7;
/// A sensor's noise of some grey levels makes corners of its own at that threshold, which nobody sees again; smoothed
/// so much it is 0.28 of what it was (1 / (2 sqrt(pi) sigma)).
constexpr double smoothing_px = 1;
/// Candidates for a place in the picture.
constexpr int candidates = 3;
/// Rays further from the axis have no place in an ideal camera: 1 / tan(80 degrees).
constexpr double least_forward = 0.17;

double focal_of(const vision::Lens& lens) {
    const auto sight = vision::project(lens, {0, 0, 1});
    return sight.has_value() ? 0.5 * (sight.value().by_ray(0, 0) + sight.value().by_ray(1, 1)) : 1;
}

} // namespace

FeatureFinder::FeatureFinder(vision::Lens lens, Eigen::Vector2i size_px, int count)
    : lens_{std::move(lens)}, size_px_{std::move(size_px)}, count_{count}, focal_px_{focal_of(lens_)},
      orb_{cv::ORB::create(candidates * count, static_cast<float>(octave_ratio), octaves, 31, 0, 2,
                           cv::ORB::HARRIS_SCORE, 31, corner_threshold)} {
    measure_half();
}

std::optional<Eigen::Vector2d> FeatureFinder::ideal_px(const Eigen::Vector2d& pixel_px) const {
    const auto ray = vision::unproject(lens_, pixel_px);
    if (!ray.has_value() || ray.value().z() < least_forward * ray.value().norm()) return std::nullopt;
    return Eigen::Vector2d(focal_px_ * ray.value().hnormalized());
}

/// From the rim of the picture.
void FeatureFinder::measure_half() {
    const Eigen::Vector2d size_px = size_px_.cast<double>();
    for (int i = 0; i <= 16; ++i)
        for (const double side : {0., 1.}) {
            for (const Eigen::Vector2d& at : {Eigen::Vector2d(i / 16., side), Eigen::Vector2d(side, i / 16.)}) {
                const auto ideal = ideal_px(at.cwiseProduct(size_px));
                if (ideal.has_value()) half_px_ = half_px_.cwiseMax(ideal.value().cwiseAbs());
            }
        }
}

/// The strongest of each cell, in each scale: cells of coarse scales are larger, but less so than what is seen in them,
/// for coarse features stand blur and noise.
std::vector<cv::KeyPoint> FeatureFinder::spread(std::vector<cv::KeyPoint> found) const {
    double scales = 0;
    for (int octave = 0; octave < octaves; ++octave) scales += 1 / octave_scale(octave);
    const double finest_px = std::sqrt(size_px_.cast<double>().prod() * scales / count_);
    std::sort(found.begin(), found.end(),
              [](const cv::KeyPoint& a, const cv::KeyPoint& b) { return a.response > b.response; });
    std::set<std::array<int, 3>> taken;
    std::erase_if(found, [&](const cv::KeyPoint& point) {
        const double cell_px = finest_px * std::sqrt(octave_scale(point.octave));
        const std::array<int, 3> cell{static_cast<int>(point.pt.x / cell_px), static_cast<int>(point.pt.y / cell_px),
                                      point.octave};
        return !taken.insert(cell).second;
    });
    return found;
}

Features FeatureFinder::find(const cv::Mat& grey) {
    cv::GaussianBlur(grey, smooth_, {}, smoothing_px);
    std::vector<cv::KeyPoint> found;
    orb_->detect(smooth_, found);
    found = spread(std::move(found));
    cv::Mat descriptors;
    orb_->compute(grey, found, descriptors);
    Features features;
    features.reserve(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        // ORB multiplies indices of a coarse picture; what it means is the middle of that picture's pixel
        const double half_px = 0.5 * octave_scale(found[i].octave);
        const auto at = ideal_px({found[i].pt.x + half_px, found[i].pt.y + half_px});
        if (!at.has_value()) continue;
        Feature& feature = features.emplace_back();
        feature.at_px = at.value();
        feature.octave = found[i].octave;
        std::memcpy(feature.descriptor.data(), descriptors.ptr(static_cast<int>(i)), sizeof(Descriptor));
    }
    return features;
}

} // namespace locus::camera
