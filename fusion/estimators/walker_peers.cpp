// Ranges between people. The other's place comes with its own uncertainty, and may rest on what this one told before:
// so it goes in by covariance intersection (filter/covariance_intersection.h), the cloud widened about its mean by the
// part that is its own, the range weighed with the rest. In a Gaussian cloud that is the paper's update exactly.
#include "fusion/estimators/walker_particles.h"

#include "fusion/filter/covariance_intersection.h"
#include "fusion/geometry/turn_and_stretch.h"

#include <algorithm>
#include <cmath>

namespace locus {
namespace {

constexpr std::size_t peer_kind = 4;

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

} // namespace

Verdict WalkerParticles::hear(const PeerRange& range, Timestamp time) noexcept {
    if (state_.missing != Missing::nothing) return {Exclusion::waiting_for_start};
    if (range.range_m <= 0 || range.range_m > settings_.max_range_m) return {Exclusion::out_of_reach};
    if (!range.other.known()) return {Exclusion::peer_without_position};
    advance(time);

    const Eigen::Vector2d other = local(range.other.position_site_m);
    const auto& c = range.other.covariance_m2;
    const Eigen::Matrix2d other_m2 =
        (Eigen::Matrix2d() << double{c[0]}, double{c[1]}, double{c[1]}, double{c[3]}).finished();
    const double sigma_m = std::isfinite(range.sigma_m) ? double{range.sigma_m} : settings_.peer_range_sigma_m;
    const double held_m = std::hypot(sigma_m, settings_.anchor_error_sigma_m);
    const Eigen::Vector2d from_other = cloud_.mean().head<2>() - other;
    const auto& mine = cloud_.covariance();
    const PeerSight sight(from_other, range.range_m, other_m2, mine.topLeftCorner<2, 2>(), held_m);

    Eigen::Matrix<double, 2, 4> view; // of the place, some seconds ahead
    view << Eigen::Matrix2d::Identity(), settings_.peer_horizon_s * product_matrix(pace());
    const Eigen::Vector4d cross = mine.leftCols<2>() * sight.towards_me;
    const double state_variance = sight.towards_me.dot(cross.head<2>());
    const filter::Intersection part = filter::intersect(
        (view * mine * view.transpose()).trace(), (view * cross).squaredNorm(), state_variance, sight.variance_m2);
    const double innovation_m = range.range_m - (from_other.norm() + sight.longer_m);
    if (!part.worth()) {
        Verdict verdict = judge(innovation_m, state_variance + sight.variance_m2);
        verdict.reason = Exclusion::no_news;
        return verdict;
    }
    const double variance = sight.variance_m2 / (1 - part.own);
    Verdict verdict = judge(innovation_m, state_variance / part.own + variance);
    if (verdict.test_ratio > 1) {
        verdict.reason = Exclusion::innovation_too_large;
        verdict.weight = 0;
        return verdict;
    }
    cloud_.widen(1 / part.own);
    cloud_.weigh_range(other, 0, std::max(0.0, range.range_m - sight.longer_m), noise(variance));
    verdict.weight = static_cast<float>(1 - part.own);
    if (!settle()) verdict.reason = Exclusion::innovation_too_large;
    if (verdict.reason == Exclusion::none) state_.kind_used[peer_kind] = time;
    return verdict;
}

} // namespace locus
