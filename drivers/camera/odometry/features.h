// ORB features of a picture (Rublee 2011, "ORB: an efficient alternative to SIFT or SURF"), spread over all of it, and
// with the lens taken out: all that follows sees an ideal camera, whose pixels count from its axis.
#pragma once

#include "fusion/vision/lens.h"

#include <Eigen/Core>
#include <opencv2/features2d.hpp>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

namespace locus::camera {

/// A picture's scales: eight, each 1.2 times as coarse as the one before (Mur-Artal 2015, section V-A).
inline constexpr int octaves = 8;
inline constexpr double octave_ratio = 1.2;
inline double octave_scale(int octave) { return std::pow(octave_ratio, octave); }

using Descriptor = std::array<std::uint64_t, 4>;

inline int difference(const Descriptor& a, const Descriptor& b) {
    return std::popcount(a[0] ^ b[0]) + std::popcount(a[1] ^ b[1]) + std::popcount(a[2] ^ b[2]) +
           std::popcount(a[3] ^ b[3]);
}

struct Feature {
    Eigen::Vector2d at_px = Eigen::Vector2d::Zero(); ///< of the ideal camera: focal length times (x / z, y / z)
    int octave = 0;
    Descriptor descriptor{};

    /// Of its place: a pixel of the scale where it was found (Mur-Artal 2015, appendix).
    double sigma_px() const { return octave_scale(octave); }
};

using Features = std::vector<Feature>;

class FeatureFinder {
  public:
    /// `lens`: of pictures of this size. `count`: how many features are aimed at.
    FeatureFinder(vision::Lens lens, Eigen::Vector2i size_px, int count);

    /// Of a grey picture.
    Features find(const cv::Mat& grey);

    double focal_px() const { return focal_px_; } ///< of the ideal camera: that of the lens on its axis
    /// Half of the ideal picture: no point outside of it can be seen.
    const Eigen::Vector2d& half_px() const { return half_px_; }

  private:
    std::vector<cv::KeyPoint> spread(std::vector<cv::KeyPoint> found) const;
    std::optional<Eigen::Vector2d> ideal_px(const Eigen::Vector2d& pixel_px) const;
    void measure_half();

    vision::Lens lens_;
    Eigen::Vector2i size_px_;
    int count_;
    double focal_px_ = 1;
    Eigen::Vector2d half_px_{0, 0};
    cv::Ptr<cv::ORB> orb_;
    cv::Mat smooth_;
};

} // namespace locus::camera
