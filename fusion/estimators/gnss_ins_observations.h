// What a vehicle's track expects of each observation, and how noisy it is: innovation, jacobian, variance. All that is
// known beforehand (settings, where the site lies on the Earth) stands here once and is shared by all copies.
#pragma once

#include "fusion/estimators/gnss_ins_settings.h"
#include "fusion/estimators/gnss_ins_track.h"
#include "fusion/geometry/earth.h"
#include "fusion/gnss/carrier_change.h"
#include "fusion/site.h"

#include <optional>

namespace locus {

/// Clocks of two constellations are known to each other within this: 300 ns and the receiver's own delays.
inline constexpr double constellation_clock_sigma_m = 300;

/// One number observed of a track.
struct GnssInsScalar {
    GnssInsTrack::Vector jacobian;
    double innovation = 0;
    double variance = 0;
};

class GnssInsObservations {
  public:
    /// `site` has an origin and outlives this.
    GnssInsObservations(const Site& site, const GnssInsSettings& settings);

    const GnssInsSettings& settings() const noexcept { return settings_; }
    const SiteOnEarth& earth() const noexcept { return earth_; }
    GnssInsMotionModel motion_model() const noexcept;

    /// Sine of a satellite's elevation, seen from the track.
    double elevation_sine(const GnssInsTrack& track, const SatelliteRange& range) const noexcept;
    /// A sigma that the device states is taken as it is.
    double code_sigma_m(const SatelliteRange& range, double elevation_sine) const noexcept;
    double rate_sigma_mps(const SatelliteRange& range, double elevation_sine) const noexcept;
    double carrier_sigma_m(const SatelliteRange& range, double elevation_sine) const noexcept;
    double satellite_error_sigma_m(double elevation_sine) const noexcept;

    // Errors that are new get a place in the state, hence the tracks that are not const.

    /// Groves eq. 14.121-14.127, with the lever arm.
    GnssInsScalar pseudorange(GnssInsTrack& track, const SatelliteRange& range) const noexcept;
    GnssInsScalar range_rate(const GnssInsTrack& track, const SatelliteRange& range) const noexcept;
    /// By how much the carrier changed since the place was held that the track holds; Groves section 14.3.2 has it as
    /// the delta range, here of two times that are both states. The noise of the phases counts anew in each change.
    GnssInsScalar carrier_change(const GnssInsTrack& track, const gnss::CarrierSight& before,
                                 const gnss::CarrierSight& now, double dt_s) const noexcept;
    /// What is kept of a satellite's carrier, seen from the track.
    gnss::CarrierSight carrier(const GnssInsTrack& track, const SatelliteRange& range) const noexcept;
    /// East, north or up. Groves eq. 14.102-14.104.
    GnssInsScalar fix_position(GnssInsTrack& track, const GnssFix& fix, int axis) const noexcept;
    GnssInsScalar fix_velocity(const GnssInsTrack& track, const GnssFix& fix, int axis) const noexcept;
    GnssInsScalar range(GnssInsTrack& track, const Range& range, const Anchor& anchor) const noexcept;

    /// The axle's speed forward, whichever way the vehicle goes unless the device tells; the scale is a state.
    GnssInsScalar wheel_speed(GnssInsTrack& track, const WheelSpeed& wheel) const noexcept;
    GnssInsScalar yaw_rate(const GnssInsTrack& track, const WheelSpeed& wheel) const noexcept;
    /// Speed of the axle to the left (axis 1) or upwards (axis 2), which is none. Groves section 15.4.1.
    GnssInsScalar slip(GnssInsTrack& track, int axis) const noexcept;
    /// Zero velocity along an axis of the Earth; what the gyroscope shows at rest. Groves section 15.3.
    GnssInsScalar standing(const GnssInsTrack& track, int axis) const noexcept;
    GnssInsScalar standing_rate(const GnssInsTrack& track, int axis) const noexcept;
    GnssInsScalar pressure(GnssInsTrack& track, const Pressure& pressure) const noexcept;
    /// Of the line between two antennas, in degrees; which way it points in the vehicle is a state. The track has an
    /// attitude.
    GnssInsScalar heading(GnssInsTrack& track, const Heading& heading) const noexcept;

    /// Height over the ellipsoid that the barometer shows, its learnt offset taken out; none before it was learnt.
    std::optional<double> height_by_pressure_m(GnssInsTrack& track, const Pressure& pressure) const noexcept;

  private:
    struct Axle {
        Eigen::Vector3d velocity_body_mps;
        double yaw_off_rad, pitch_off_rad;
        int yaw_at, pitch_at;
    };
    Axle axle(GnssInsTrack& track) const noexcept;
    void spread_axle(const GnssInsTrack& track, const Eigen::Vector3d& gradient_body,
                     GnssInsTrack::Vector& jacobian) const noexcept;

    GnssInsSettings settings_;
    SiteOnEarth earth_;
    Eigen::Vector3d antenna_body_m_, tag_body_m_, axle_body_m_;
};

} // namespace locus
