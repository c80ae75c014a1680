// A sight as seen from a place: with all taken out that only the place tells, the Earth's turn and the air, and with
// how far it is to be believed there.
#pragma once

#include "fusion/gnss/atmosphere.h"
#include "fusion/gnss/correction.h"
#include "fusion/gnss/sight.h"

#include <optional>
#include <span>

namespace locus::gnss {

struct SightFrom {
    Sight sight;
    std::optional<Correction> correction{}; ///< of a base station
    Exclusion reason = Exclusion::none;     ///< not none: left out
    bool rate_agrees = true;                ///< false: its Doppler is left out

    // What observe() fills in.
    Eigen::Vector3d satellite_ecef_m{0, 0, 0};  ///< turned by the Earth's rotation during the way
    Eigen::Vector3d velocity_ecef_mps{0, 0, 0}; ///< alike
    Eigen::Vector3d towards{0, 0, 0};           ///< unit vector to the satellite
    double elevation_rad = 0;
    bool is_corrected = false; ///< by the base station: only where that makes it surer
    double range_m = 0;        ///< pseudorange without satellite's clock, ionosphere and troposphere
    double carrier_m = 0;      ///< alike; 0: none
    double variance_m2 = 1;
    double rate_variance_m2ps2 = 1;
};

/// What lies between receiver and satellites.
struct Sky {
    GpsTime time;
    std::optional<Klobuchar> ionosphere; ///< empty: the usual one, believed less
};

class Observer {
  public:
    explicit Observer(const GnssSettings& settings);

    /// All but the air, where the place is not known yet: no horizon, all believed alike.
    static void turn(std::span<SightFrom> sights, const Eigen::Vector3d& from_ecef_m) noexcept;

    /// All, and those below the mask have that for their reason. Some 100 km do not matter for the air.
    void observe(std::span<SightFrom> sights, const Sky& sky, const Eigen::Vector3d& from_ecef_m) const noexcept;

  private:
    void take_out_air(SightFrom& s, const Sky& sky, const Geodetic& at, const LookAngles& look) const noexcept;
    void correct(SightFrom& s, const Eigen::Vector3d& at_ecef_m, double height_m) const noexcept;

    GnssSettings settings_;
    double mask_rad_;
};

} // namespace locus::gnss
