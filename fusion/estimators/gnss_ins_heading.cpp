// The heading of two GNSS antennas: what a vehicle's track expects of it, and how it gives an attitude to a vehicle
// that has not driven yet.
#include "fusion/estimators/gnss_ins.h"
#include "fusion/estimators/gnss_ins_errors.h"

#include <algorithm>
#include <cmath>

namespace locus {
namespace {

/// A miscounted cycle of the carrier (19 cm) that still fits all satellites moves an antenna by a quarter of it or
/// more.
constexpr double wrong_cycle_m = 0.05;
/// From so far off the filter aligns; the heading itself, taken in right after, makes it as sure as it is.
constexpr double unaligned_sigma_deg = 20;
/// A line that stands nearly upright has no heading: this share of it lies on the level then.
constexpr double least_level_share = 0.1;

} // namespace

/// In degrees, like the heading; the errors that stay are states in degrees.
GnssInsScalar GnssInsObservations::heading(GnssInsTrack& track, const Heading& heading) const noexcept {
    const int mounting_at = track.wanderer(heading_mounting_error, {settings_.heading_mounting_sigma_deg, no_limit});
    const int reflections_at =
        track.wanderer(heading_error, {settings_.heading_error_sigma_deg, settings_.heading_error_time_s});
    const double mounting_rad = settings_.heading_mounting_deg * rad_per_deg;
    const Eigen::Vector3d line =
        track.body_to_ecef() * Eigen::Vector3d(std::cos(mounting_rad), std::sin(mounting_rad), 0);
    const Eigen::Matrix3d enu = enu_to_ecef(geodetic(track.position_m()));
    const double east = enu.col(0).dot(line), north = enu.col(1).dot(line);
    const double level2 = std::max(east * east + north * north, own_square(least_level_share));
    const Eigen::Vector3d by_attitude = line.cross(north * enu.col(0) - east * enu.col(1)) / level2;

    GnssInsScalar scalar{blank_row(track)};
    for (int axis = 0; axis < 3; ++axis)
        scalar.jacobian(GnssInsTrack::place(axis, 2)) = by_attitude(axis) / rad_per_deg;
    scalar.jacobian(mounting_at) = scalar.jacobian(reflections_at) = 1;
    const double expected_deg =
        std::atan2(east, north) / rad_per_deg + track.state(mounting_at) + track.state(reflections_at);
    scalar.innovation = std::remainder(heading.heading_deg - expected_deg, 360.0);
    scalar.variance = own_square(stated_or(heading.sigma_deg, settings_.heading_sigma_deg));
    return scalar;
}

bool GnssIns::is_wrong_baseline(const Heading& heading) const noexcept {
    return settings().heading_baseline_m > 0 && std::isfinite(heading.baseline_m) &&
           std::abs(double{heading.baseline_m} - settings().heading_baseline_m) > wrong_cycle_m;
}

/// A standing vehicle has no course; two antennas tell all the same where it points.
bool GnssIns::begin_inertial_towards(const Heading& heading) noexcept {
    const double forward_deg = heading.heading_deg + settings().heading_mounting_deg;
    return track_.begin_inertial_towards((90 - forward_deg) * rad_per_deg, unaligned_sigma_deg * rad_per_deg);
}

Verdict GnssIns::take(const Heading& heading, Timestamp time) noexcept {
    if (!settings().use_heading) return {Exclusion::disabled};
    if (is_wrong_baseline(heading)) return {Exclusion::wrong_baseline};
    if (!started_) return {Exclusion::waiting_for_start};
    move_to(time);
    if (!track_.is_inertial() && !begin_inertial_towards(heading)) return {Exclusion::no_attitude};
    return weigh(Aid::heading, observations_->heading(track_, heading),
                 gates_[static_cast<std::size_t>(Aid::heading)][0]);
}

} // namespace locus
