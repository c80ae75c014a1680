#include "fusion/estimators/chan_taylor.h"

#include <algorithm>

namespace locus {

void LastFix::take(const Eigen::Vector3d& position_m, const Eigen::Matrix3d& covariance_m2, Timestamp time) noexcept {
    position_m_ = position_m;
    covariance_m2_ = covariance_m2;
    time_ = time;
}

void LastFix::write(Timestamp time, Estimate& estimate) const noexcept {
    const double age_s = std::max(0.0, to_s(time - time_));
    const double speed_variance = speed_sigma_mps_ * speed_sigma_mps_;
    Eigen::Map<Eigen::Vector3d>(estimate.position_site_m.data()) = position_m_;
    Eigen::Map<Eigen::Matrix<double, 6, 6>> covariance(estimate.covariance.data());
    covariance.topLeftCorner<3, 3>() = covariance_m2_;
    for (int i = 0; i < axes_; ++i) {
        covariance(i, i) += speed_variance * age_s * age_s;
        covariance(i, 3 + i) = covariance(3 + i, i) = speed_variance * age_s;
        covariance(3 + i, 3 + i) = speed_variance;
    }
}

} // namespace locus
