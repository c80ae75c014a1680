// What a navigation filter makes of a SLAM's path that was aligned with the site (aligned_place.h).
#include "fusion/estimators/carried_keys.h"
#include "fusion/estimators/nav_filter.h"

namespace locus {

Verdict NavFilter::see(const AlignedPlace& place, const Measurement& odometry) noexcept {
    if (!has_position() || unheard_s(odometry.time) > forget_after_s()) return {Exclusion::waiting_for_start};
    move_to(odometry.time);
    const int axes = settings_.planar ? 2 : 3, told = static_cast<int>(++places_ % static_cast<std::uint32_t>(axes));
    Verdict verdict;
    for (int axis = 0; axis < axes; ++axis) { // each by turns is the one that speaks for all
        const Verdict one = see_along(axis, place);
        const bool refused = one.reason != Exclusion::none;
        if (refused || (axis == told && verdict.reason == Exclusion::none)) verdict = one;
    }
    if (verdict.reason != Exclusion::none) return verdict;
    note_use(odometry.observation, odometry.time);
    note_place(odometry.time);
    return verdict;
}

Verdict NavFilter::see_along(int axis, const AlignedPlace& place) noexcept {
    const int error_at =
        track_.wanderer(carried::odometry(place.alignment, axis), {place.held_sigma_m(axis), place.held_time_s(axis)});
    Scalar scalar;
    scalar.jacobian.setZero(track_.size());
    track_.spread_gradient(Eigen::Vector3d::Unit(axis), scalar.jacobian);
    scalar.jacobian(error_at) = 1;
    scalar.variance = place.noise_sigma_m * place.noise_sigma_m;
    scalar.innovation = place.position_site_m(axis) - track_.antenna_site_m()(axis) - track_.state(error_at);
    return weigh(scalar, place_gates_[static_cast<std::size_t>(axis)], place_robust_);
}

} // namespace locus
