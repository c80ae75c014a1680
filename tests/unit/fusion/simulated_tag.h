// A tag drawn from the range filter's own model: acceleration that dies away, anchor errors that wander and that stay,
// white noise.
// Against it a filter must be consistent; against anything else it can only be useful.
#pragma once

#include "fusion/estimators/range_ekf_settings.h"
#include "fusion/filter/motion.h"
#include "fusion/geometry/vector.h"
#include "fusion/measurement.h"
#include "fusion/site.h"

#include <Eigen/Dense>

#include <cmath>
#include <random>
#include <vector>

namespace locus::test {

inline Site hall() {
    Site site;
    for (const double x : {-4., 4.})
        for (const double y : {-4., 4.})
            for (const double z : {0.2, 3.}) site.anchors.push_back({"", address(site.anchors.size()), {x, y, z}});
    return site;
}

class SimulatedTag {
  public:
    SimulatedTag(const Site& site, const RangeEkfSettings& settings, unsigned seed)
        : site_(site), settings_(settings), random_(seed), anchor_error_m_(site.anchors.size()) {
        for (int axis = 0; axis < axes(); ++axis) {
            motion_(1, axis) = settings.speed_sigma_mps * normal_(random_);
            motion_(2, axis) = settings.acceleration_sigma_mps2 * normal_(random_);
        }
        motion_.row(0) << 0.5, -0.5, settings.planar ? settings.height_m : 1.5;
        for (double& error_m : anchor_error_m_) error_m = settings.anchor_error_sigma_m * normal_(random_);
        common_m_ = settings.common_range_error_sigma_m * normal_(random_);
        std::mt19937_64 surveyor(seed + 1000); // its own: the walk stays the same whatever the survey was like
        for (std::size_t i = 0; i < site.anchors.size(); ++i)
            offset_m_.push_back(settings.anchor_offset_sigma_m * normal_(surveyor));
    }

    void move(double dt_s) {
        const auto step = filter::axis_step({settings_.acceleration_sigma_mps2, settings_.acceleration_time_s}, dt_s);
        const Eigen::Matrix3d root = step.noise.llt().matrixL();
        for (int axis = 0; axis < axes(); ++axis)
            motion_.col(axis) = (step.transition * motion_.col(axis) +
                                 root * Eigen::Vector3d::NullaryExpr([&] {
                                     return draw();
                                 })).eval();
        const auto wander = filter::wander_step(settings_.anchor_error_sigma_m, settings_.anchor_error_time_s, dt_s);
        for (double& error_m : anchor_error_m_) error_m = wander.keep * error_m + std::sqrt(wander.variance) * draw();
        time_s_ += dt_s;
    }

    Measurement range(std::size_t anchor) {
        const double noise_m = settings_.range_sigma_m * draw();
        return at_now(Range{site_.anchors[anchor].address, address(9),
                            heard_m(anchor) + offset_m_[anchor] + common_m_ + noise_m});
    }
    Measurement difference(std::size_t a, std::size_t b) {
        const double noise_m = settings_.range_difference_sigma_m * draw();
        return at_now(RangeDifference{site_.anchors[a].address, site_.anchors[b].address, address(9),
                                      heard_m(b) - heard_m(a) + noise_m});
    }

    /// Rows position, velocity, acceleration; a column for each axis.
    const Eigen::Matrix3d& motion() const { return motion_; }
    double time_s() const { return time_s_; }

  private:
    int axes() const { return settings_.planar ? 2 : 3; }
    double draw() { return normal_(random_); }
    double heard_m(std::size_t anchor) const {
        const Eigen::Vector3d anchor_site_m = vector(site_.anchors[anchor].position_site_m);
        return (motion_.row(0).transpose() - anchor_site_m).norm() + anchor_error_m_[anchor];
    }
    Measurement at_now(const Observation& observation) const { return {timestamp_from_s(time_s_), 0, 0, observation}; }

    const Site& site_;
    RangeEkfSettings settings_;
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
    Eigen::Matrix3d motion_ = Eigen::Matrix3d::Zero();
    std::vector<double> anchor_error_m_;
    std::vector<double> offset_m_;
    double common_m_ = 0;
    double time_s_ = 1;
};

} // namespace locus::test
