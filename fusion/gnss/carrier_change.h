// Time-differenced carrier phase: by how much a satellite's carrier changed since the epoch before, which is how much
// the range changed and the receiver's clock ran, to millimetres, whatever the carrier's unknown constant is (van Graas
// and Soloviev, Precise velocity estimation using a stand-alone GPS receiver, NAVIGATION 51(4), 2004). It says nothing
// when the carrier was lost or slipped between the two; that is what stands here.
#pragma once

#include "fusion/aid_status.h"

#include <Eigen/Core>

#include <span>

namespace locus::gnss {

/// What is kept of a satellite's carrier from one epoch to the next.
struct CarrierSight {
    Vec3 satellite_ecef_m{};
    double carrier_m = 0;
    double sigma_m = 0;   ///< of the carrier
    double drift_mps = 0; ///< sigma: by which orbit, clock and air change
    double rate_mps = 0;  ///< of the pseudorange; NaN: none
    double rate_sigma_mps = 0;
    float lock_s = 0;
    std::uint8_t constellation = 0, satellite = 0;
    CarrierUse use = CarrierUse::none; ///< what became of its change since the epoch before
};

/// Sigma of the change over `dt_s`: two phases, and what the satellite and the air do meanwhile.
double change_sigma_m(const CarrierSight& before, const CarrierSight& now, double dt_s) noexcept;

/// Whether the lock is older than the epoch before and grew by no more than the time between: one that began
/// anew does not, nor one whose device broke it for an epoch, where half a cycle came into doubt or the clock was set.
bool is_unbroken(const CarrierSight& before, const CarrierSight& now, double dt_s) noexcept;

/// By how much the carrier changed more than the Dopplers of its two ends say. NaN where one has none.
double beyond_doppler_m(const CarrierSight& before, const CarrierSight& now, double dt_s) noexcept;

/// Sigma of that: the Dopplers' noise, the carrier's, and what the vehicle does between them.
double beyond_doppler_sigma_m(const CarrierSight& before, const CarrierSight& now, double dt_s) noexcept;

/// A change as an equation: of a step of the antenna and of the clock, both in m.
struct CarrierEquation {
    Eigen::Vector4d row = Eigen::Vector4d::Zero();
    double residual_m = 0;
    double variance_m2 = 0;
    double beyond_m = 0, beyond_sigma_m = 0; ///< as above
    bool agrees = true;                      ///< false: left out
};

/// Leaves out the changes that differ from their Dopplers otherwise than most do: what they have in common is the
/// clock, whose wandering no mean of two rates knows. Fewer than three with Dopplers: they stay.
void leave_out_against_doppler(std::span<CarrierEquation> equations, double gate_in_sigma) noexcept;

/// Leaves out the changes that do not agree with the others, the one that sticks out most first; all of them when
/// nothing tells which it is. Too few to test: they stay. `normal_quantile`: of one less the chance of a false alarm.
void leave_out_slips(std::span<CarrierEquation> equations, double normal_quantile) noexcept;

} // namespace locus::gnss
