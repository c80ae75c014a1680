// What a navigation filter makes of the feet that a camera sees: who stands on the floor has his tag above his feet,
// and at about the height at which tags are worn.
#include "fusion/estimators/carried_keys.h"
#include "fusion/estimators/foot_evidence.h"
#include "fusion/estimators/nav_filter.h"
#include "fusion/geometry/vector.h"

#include <Eigen/Eigenvalues>

#include <cmath>

namespace locus {
namespace {

/// Of the body's sway, new at each step; the rest of the doubt in the height is carried.
constexpr double sway_sigma_m = 0.05;

} // namespace

Verdict NavFilter::take(const FootPoint& foot, Timestamp time) noexcept {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(covariance_of(foot));
    if (!(axes.eigenvalues()(0) > 0)) return {Exclusion::not_finite};
    if (!has_position() || unheard_s(time) > forget_after_s()) {
        start_on_foot(foot, time);
        return {};
    }
    move_to(time);
    const Verdict narrow = see_feet(foot, axes.eigenvectors().col(0), axes.eigenvalues()(0), foot_gates_[0]);
    const Verdict wide = see_feet(foot, axes.eigenvectors().col(1), axes.eigenvalues()(1), foot_gates_[1]);
    if (narrow.reason != Exclusion::none && wide.reason != Exclusion::none) return narrow;
    stand_on_floor();
    note_use(foot, time);
    note_place(time);
    return narrow.test_ratio > wide.test_ratio && narrow.reason == Exclusion::none ? narrow : wide;
}

void NavFilter::start_on_foot(const FootPoint& foot, Timestamp time) noexcept {
    Eigen::Vector3d tag_m(foot.position_site_m[0], foot.position_site_m[1], settings_.tag_height_m);
    if (settings_.planar) tag_m.z() = settings_.height_m;
    const double carried_m2 = settings_.foot_error_sigma_m * settings_.foot_error_sigma_m;
    Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
    covariance_m2.topLeftCorner<2, 2>() = covariance_of(foot) + carried_m2 * Eigen::Matrix2d::Identity();
    covariance_m2(2, 2) = settings_.tag_height_sigma_m * settings_.tag_height_sigma_m;
    start_at(tag_m, covariance_m2, time);
    note_use(foot, time);
}

/// Along one axis of its ellipse, so that the two numbers are independent. What stays from image to image (the tag is
/// worn beside the feet, the box is cut alike, the tracker smooths) is an error that is carried along.
Verdict NavFilter::see_feet(const FootPoint& foot, const Eigen::Vector2d& axis, double variance_m2,
                            filter::Gate& gate) noexcept {
    const filter::WanderModel error{settings_.foot_error_sigma_m, settings_.foot_error_time_s};
    const int error_at[] = {track_.wanderer(carried::feet(foot.camera, 0), error),
                            track_.wanderer(carried::feet(foot.camera, 1), error)};
    Scalar scalar;
    scalar.jacobian.setZero(track_.size());
    track_.spread_gradient({axis.x(), axis.y(), 0}, scalar.jacobian);
    const Eigen::Vector3d tag_m = track_.antenna_site_m();
    for (int i = 0; i < 2; ++i) {
        scalar.jacobian(error_at[i]) = axis(i);
        const double expected_m = tag_m(i) + track_.state(error_at[i]);
        scalar.innovation += axis(i) * (foot.position_site_m[static_cast<std::size_t>(i)] - expected_m);
    }
    scalar.variance = variance_m2;
    return weigh(scalar, gate, foot_robust_);
}

void NavFilter::stand_on_floor() noexcept {
    if (settings_.planar) return;
    const int error_at =
        track_.wanderer(carried::worn_height, {settings_.tag_height_sigma_m, settings_.tag_height_time_s});
    Scalar scalar;
    scalar.jacobian.setZero(track_.size());
    track_.spread_gradient(Eigen::Vector3d::UnitZ(), scalar.jacobian);
    scalar.jacobian(error_at) = 1;
    scalar.variance = sway_sigma_m * sway_sigma_m;
    scalar.innovation = settings_.tag_height_m - (track_.antenna_site_m().z() + track_.state(error_at));
    weigh(scalar, floor_gate_, height_robust_);
}

} // namespace locus
