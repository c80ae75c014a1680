// What is known of one clock against another at one moment: offset, rate and drift with their covariance, in ticks and
// seconds. The algebra of a Kalman filter of three states, and nothing that knows of packets.
#pragma once

#include "fusion/uwb/clock_sync/settings.h"

#include <Eigen/Core>

namespace locus::uwb {

/// Noise of one clock against another, from the settings of a crystal: two crystals, so twice the variance.
struct CrystalModel {
    explicit CrystalModel(const ClockSyncSettings& settings);

    double rate_variance;    ///< (ticks/s)^2, before anything is known
    double drift_variance;   ///< (ticks/s^2)^2, before anything is known
    double offset_walk;      ///< ticks^2/s
    double drift_walk;       ///< (ticks/s^2)^2/s
    double arrival_variance; ///< ticks^2
};

struct ClockState {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero(); ///< ticks, ticks/s, ticks/s^2
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();

    /// After one packet, of which only the offset is known.
    static ClockState first(const CrystalModel& crystal);

    /// `dt_s` later; backwards the uncertainty grows as well.
    ClockState after(double dt_s, const CrystalModel& crystal) const;

    double offset_ticks() const { return mean(0); }
    double offset_variance() const { return covariance(0, 0); }

    /// Of the offset now with the offset `dt_s` later.
    double covariance_with_later_offset(double dt_s) const;

    /// Takes in an offset that was measured `innovation_ticks` above what was expected. Joseph's form: the covariance
    /// stays one whatever the rounding.
    void update(double innovation_ticks, double measured_variance);
};

} // namespace locus::uwb
