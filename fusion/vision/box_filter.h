// A person's box as it moves through the image: the filter of SORT and DeepSORT, constant velocity and noise in
// proportion to the box's height, but in seconds instead of frames, and measured edge by edge. Its steady point is the
// foot point (middle of the bottom edge): feet are what we are for.
#pragma once

#include "fusion/vision/detection.h"
#include "fusion/vision/extent.h"

namespace locus::vision {

/// Lengths are in heights of the box.
struct BoxNoise {
    double edge = 0.1; ///< of one edge; DeepSORT's 1/20 of a box's middle are 0.07, good detectors on sharp pictures
    double acceleration = 0.3; ///< heights / s^1.5: a person of 1.7 m changes his pace by 0.5 m/s within 1 s
    double start_speed = 0.8;  ///< heights / s: a walker's 1.4 m/s
    double size_change = 0.05; ///< heights / s^0.5: 1.4 m/s towards a camera 30 m away
};

class BoxFilter {
  public:
    BoxFilter(const BoxPx& box, const BoxNoise& noise) noexcept;

    void predict(double dt_s) noexcept;
    void update(const BoxPx& box) noexcept;
    /// When something stands before his feet: all edges but the bottom.
    void update_without_feet(const BoxPx& box) noexcept;

    BoxPx box() const noexcept;
    double height_px() const noexcept { return vertical_.size_px(); }
    Eigen::Vector2d foot_px() const noexcept { return {horizontal_.place_px(), vertical_.place_px()}; }
    Eigen::Vector2d head_px() const noexcept { return {horizontal_.place_px(), vertical_.lower_px()}; }
    Eigen::Matrix2d foot_covariance_px2() const noexcept;
    Eigen::Matrix2d head_covariance_px2() const noexcept;

    /// Of a detection: Mahalanobis distance squared with four degrees of freedom (DeepSORT eq. 1), and ln(det S / det
    /// R).
    Extent::Distance distance(const BoxPx& box) const noexcept;

  private:
    BoxNoise noise_;
    Extent horizontal_, vertical_;

    double edge_variance_px2() const noexcept;
};

} // namespace locus::vision
