// A single point: position and clocks of a receiver from the pseudoranges of one epoch, velocity from its Dopplers, by
// weighted least squares; and whether the observations agree with one another. Those that do not are excluded one at a
// time (receiver autonomous integrity monitoring), the one that sticks out most first.
#pragma once

#include "fusion/gnss/sight_from.h"
#include "fusion/gnss/signals.h"

namespace locus::gnss {

struct SinglePoint {
    Eigen::Vector3d position_ecef_m{0, 0, 0};
    Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Identity();
    std::array<double, clock_count> clocks_m{}; ///< of the receiver, by clock_of(); 0: no satellite tells
    int satellites = 0;
    int corrected = 0;      ///< of these, by a base station
    bool consistent = true; ///< false: they disagree, and nothing tells which one it is; the covariance is wider for it

    std::optional<Eigen::Vector3d> velocity_ecef_mps;
    Eigen::Matrix3d velocity_covariance_m2ps2 = Eigen::Matrix3d::Identity();
    double clock_drift_mps = 0; ///< one for all: the receiver has one crystal
};

class SinglePointSolver {
  public:
    /// For construction only: throws std::domain_error for a false_alarm that is no probability.
    explicit SinglePointSolver(const GnssSettings& settings);

    /// Empty when there are too few satellites (4, and one more for each constellation after the first), or they stand
    /// so that nothing follows. Wherever `near_ecef_m` is, the place is the same; near it fewer steps are needed, and
    /// the Earth's centre will do. Afterwards every sight is as seen from the solution, and those that were left out
    /// have their reason; without a solution those that were tried and left out.
    std::optional<SinglePoint> solve(std::span<SightFrom> sights, const Sky& sky,
                                     const Eigen::Vector3d& near_ecef_m) const noexcept;

    const Observer& observer() const noexcept { return observer_; }

  private:
    void solve_velocity(std::span<SightFrom> sights, SinglePoint& point) const noexcept;

    Observer observer_;
    double normal_quantile_; ///< of 1 - false_alarm
};

} // namespace locus::gnss
