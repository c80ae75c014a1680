#include "fusion/inertial/stance.h"

#include "fusion/geometry/rotation.h"
#include "fusion/units.h"

namespace locus::inertial {

bool StanceDetector::hear(const Eigen::Vector3d& specific_force_mps2, const Eigen::Vector3d& angular_rate_radps,
                          double dt_s) noexcept {
    const bool gap = dt_s > settings_.window_s;
    if (gap) {
        window_.clear();
        span_s_ = 0;
    }
    forget();
    window_.push_back({specific_force_mps2, angular_rate_radps, gap ? 0 : dt_s});
    span_s_ += window_.back().dt_s;
    statistic_ = likelihood_ratio();
    const bool filled = span_s_ >= 0.8 * settings_.window_s || window_.size() == decltype(window_)::capacity();
    return filled && statistic_ < settings_.threshold;
}

void StanceDetector::forget() noexcept {
    while (!window_.empty() && (span_s_ > settings_.window_s || window_.size() == decltype(window_)::capacity())) {
        span_s_ -= window_.front().dt_s;
        window_.erase(window_.begin());
    }
}

double StanceDetector::likelihood_ratio() const noexcept {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Sample& sample : window_) mean += sample.force;
    const Eigen::Vector3d gravity = mean.normalized() * standard_gravity_mps2;
    double force = 0, rate = 0;
    for (const Sample& sample : window_) {
        force += (sample.force - gravity).squaredNorm();
        rate += sample.rate.squaredNorm();
    }
    const double force_variance = settings_.force_sigma_mps2 * settings_.force_sigma_mps2;
    const double rate_variance = settings_.rate_sigma_radps * settings_.rate_sigma_radps;
    return (force / force_variance + rate / rate_variance) / static_cast<double>(window_.size());
}

} // namespace locus::inertial
