#include "fusion/estimators/foot_filter.h"

#include "fusion/estimators/foot_evidence.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace locus {
namespace {

/// No tracker knows feet better than this, whatever it says: a zero covariance would make the filter sure for ever.
constexpr double least_foot_sigma_m = 0.01;

Eigen::Matrix3d with_height(const FootPoint& foot, double beside_sigma_m) noexcept {
    const double beside_m2 = std::max(beside_sigma_m * beside_sigma_m, least_foot_sigma_m * least_foot_sigma_m);
    Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
    covariance_m2.topLeftCorner<2, 2>() = covariance_of(foot) + beside_m2 * Eigen::Matrix2d::Identity();
    return covariance_m2;
}

Verdict judge(const filter::FixFilter::Innovation& innovation, double gate_in_sigma) noexcept {
    return judge_on_floor(innovation.value_m.head<2>(), innovation.covariance_m2.topLeftCorner<2, 2>(), gate_in_sigma);
}

} // namespace

Verdict FootFilter::take(const FootPoint& foot, Timestamp time) noexcept {
    if (!is_sound(foot)) return {Exclusion::not_finite};
    const Eigen::Vector3d place_m(foot.position_site_m[0], foot.position_site_m[1], 0);
    const Eigen::Matrix3d covariance_m2 = with_height(foot, model_.beside_sigma_m);
    Verdict verdict;
    if (filter_.is_started() && time - filter_.last_fix() > model_.memory) filter_.stop();
    if (filter_.is_started()) {
        verdict = judge(filter_.innovation(place_m, covariance_m2, time), model_.gate_in_sigma);
        const bool is_far = verdict.test_ratio > 1;
        if (is_far && time - filter_.last_fix() <= model_.patience) return kept_out(verdict);
        if (is_far) {
            filter_.stop();
            ++jumps_;
        }
    }
    filter_.take(place_m, covariance_m2, time);
    return verdict;
}

filter::PlaneKnowledge FootFilter::at(Timestamp time) const noexcept {
    Estimate estimate;
    filter_.write(time, estimate);
    return plane_of(estimate);
}

filter::PlaneKnowledge plane_of(const Estimate& estimate) noexcept {
    constexpr std::array<int, 4> plane{0, 1, 3, 4};
    const Eigen::Map<const Eigen::Matrix<double, 6, 6>> covariance(estimate.covariance.data());
    filter::PlaneKnowledge known;
    known.state << estimate.position_site_m[0], estimate.position_site_m[1], estimate.velocity_site_mps[0],
        estimate.velocity_site_mps[1];
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) known.covariance(i, j) = covariance(plane[i], plane[j]);
    return known;
}

} // namespace locus
