// The change of a satellite's carrier between two epochs, as a vehicle's track expects it of the place that it holds
// and the one where it is.
#include "fusion/estimators/gnss_ins_errors.h"
#include "fusion/estimators/gnss_ins_observations.h"
#include "fusion/geometry/vector.h"

#include <array>
#include <cmath>

namespace locus {

gnss::CarrierSight GnssInsObservations::carrier(const GnssInsTrack& track, const SatelliteRange& range) const noexcept {
    const double sine = elevation_sine(track, range);
    gnss::CarrierSight sight;
    sight.satellite_ecef_m = range.satellite_ecef_m;
    sight.carrier_m = range.carrier_m;
    sight.sigma_m = carrier_sigma_m(range, sine);
    sight.drift_mps = settings_.carrier_drift_sigma_mps / sine;
    sight.rate_mps = double{range.range_rate_mps};
    sight.rate_sigma_mps = rate_sigma_mps(range, sine);
    sight.lock_s = range.lock_s;
    sight.constellation = range.constellation;
    sight.satellite = range.satellite;
    return sight;
}

GnssInsScalar GnssInsObservations::carrier_change(const GnssInsTrack& track, const gnss::CarrierSight& before,
                                                  const gnss::CarrierSight& now, double dt_s) const noexcept {
    const std::array<int, 4> held = track.held_place();
    const Eigen::Vector3d held_m(track.state(held[0]), track.state(held[1]), track.state(held[2]));
    const Eigen::Vector3d arm_before = vector(before.satellite_ecef_m) - held_m;
    const Eigen::Vector3d arm = vector(now.satellite_ecef_m) - track.point_ecef_m(antenna_body_m_);
    GnssInsScalar scalar{blank_row(track)};
    track.spread_position(-arm.normalized(), antenna_body_m_, scalar.jacobian);
    const Eigen::Vector3d sight_before = arm_before.normalized();
    for (std::size_t axis = 0; axis < 3; ++axis)
        scalar.jacobian(held[axis]) = sight_before(static_cast<Eigen::Index>(axis));
    scalar.jacobian(clock_offset_at) = 1;
    scalar.jacobian(held[3]) = -1;
    const double expected_m = arm.norm() - arm_before.norm() + track.state(clock_offset_at) - track.state(held[3]);
    scalar.innovation = now.carrier_m - before.carrier_m - expected_m;
    scalar.variance = own_square(gnss::change_sigma_m(before, now, dt_s));
    return scalar;
}

} // namespace locus
