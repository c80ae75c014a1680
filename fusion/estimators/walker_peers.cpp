// Ranges between people. The other's place comes with its own uncertainty, and may rest on what this one told before:
// so it goes in by covariance intersection (filter/covariance_intersection.h), the cloud widened about its mean by the
// part that is its own, the range weighed with the rest. In a Gaussian cloud that is the paper's update exactly.
#include "fusion/estimators/walker_particles.h"

#include "fusion/geometry/turn_and_stretch.h"

#include <algorithm>
#include <cmath>

namespace locus {
namespace {

/// What a range to somebody who is not quite known says: mean and variance of the range from here to there. Where both
/// are less sure than they are far apart, the direction means nothing; the second-order terms of the distance say by
/// how much it is longer and how much wider for that (Bar-Shalom, Li, Kirubarajan 2001, section 10.3).
struct PeerSight {
    Eigen::Vector2d towards_me{0, 0};
    double longer_m = 0;
    double variance_m2 = 0; ///< of the range's noise and the other's place

    PeerSight(const Eigen::Vector2d& from_other, double range_m, const Eigen::Matrix2d& other,
              const Eigen::Matrix2d& mine, double sigma_m) {
        const double apart_m = std::max({from_other.norm(), range_m, 0.1});
        towards_me = from_other / std::max(from_other.norm(), 1e-6);
        const Eigen::Vector2d across(-towards_me.y(), towards_me.x());
        const double across_m2 = across.dot((other + mine) * across);
        longer_m = 0.5 * across_m2 / apart_m;
        variance_m2 = sigma_m * sigma_m + towards_me.dot(other * towards_me) + 2 * longer_m * longer_m;
    }
};

Eigen::Matrix2d floor_m2(const PeerBelief& belief) {
    const auto& c = belief.covariance_m2;
    return (Eigen::Matrix2d() << double{c[0]}, double{c[1]}, double{c[1]}, double{c[3]}).finished();
}

} // namespace

Verdict WalkerParticles::hear(const PeerRange& range, Timestamp time) noexcept {
    if (state_.missing != Missing::nothing) return {Exclusion::waiting_for_start};
    if (range.range_m <= 0 || range.range_m > settings_.max_range_m) return {Exclusion::out_of_reach};
    if (!range.other.known()) return {Exclusion::peer_without_position};
    walk_.advance(time);

    const Eigen::Vector2d other = walk_.local(range.other.position_site_m);
    const Eigen::Vector2d from_other = cloud().mean().head<2>() - other;
    const double sigma_m = std::isfinite(range.sigma_m) ? double{range.sigma_m} : settings_.peer_range_sigma_m;
    const PeerSight sight(from_other, range.range_m, floor_m2(range.other), cloud().covariance().topLeftCorner<2, 2>(),
                          std::hypot(sigma_m, settings_.anchor_error_sigma_m));
    const double state_variance = sight.towards_me.dot(cloud().covariance().topLeftCorner<2, 2>() * sight.towards_me);
    const filter::Intersection part = share_with(sight.towards_me, state_variance, sight.variance_m2);
    const double innovation_m = range.range_m - (from_other.norm() + sight.longer_m);
    if (!part.worth()) {
        const double sigma = std::sqrt(state_variance + sight.variance_m2);
        return kept_out(verdict_of(innovation_m, sigma, gate_in_sigma_), Exclusion::no_news);
    }
    const double variance = sight.variance_m2 / (1 - part.own);
    Verdict verdict = verdict_of(innovation_m, std::sqrt(state_variance / part.own + variance), gate_in_sigma_);
    if (verdict.test_ratio > 1) return kept_out(verdict);
    particles().widen(1 / part.own);
    particles().weigh_range(other, 0, std::max(0.0, range.range_m - sight.longer_m), noise(variance));
    verdict.weight = static_cast<float>(1 - part.own);
    return settle() ? verdict : kept_out(verdict);
}

/// How much of itself the cloud keeps beside what the other tells, for the surest position some seconds ahead.
filter::Intersection WalkerParticles::share_with(const Eigen::Vector2d& direction, double state_variance,
                                                 double variance_m2) const noexcept {
    const auto& mine = cloud().covariance();
    Eigen::Matrix<double, 2, 4> view; // of the place then
    view << Eigen::Matrix2d::Identity(), settings_.peer_horizon_s * product_matrix(walk_.pace());
    const Eigen::Vector4d cross = mine.leftCols<2>() * direction;
    return filter::intersect((view * mine * view.transpose()).trace(), (view * cross).squaredNorm(), state_variance,
                             variance_m2);
}

} // namespace locus
