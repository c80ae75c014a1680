// Kalman filter of a target that keeps its velocity, on positions that something else found. Each axis has position,
// velocity and, where a share of the position's error is said to stay from one fix to the next, that error as a third
// number: the "augmented" filter that paper 000 compares with. Without such a share it is the plain filter.
#pragma once

#include "fusion/pose.h"

#include <Eigen/Core>

namespace locus::filter {

struct FixFilterModel {
    double velocity_walk = 1.3; ///< standard deviation that the velocity gains, m/s per root of a second
    double start_speed_sigma_mps = 1;
    double carried_share = 0; ///< 0..1 of a fix's variance that is an error carried along (Gauss-Markov)
    double carried_time_s = 0.3;
    bool planar = false; ///< the height is known: nothing moves it
};

class FixFilter {
  public:
    explicit FixFilter(const FixFilterModel& model) noexcept : model_(model) {}

    /// A position with its covariance in m^2; the first one starts the filter. `time` does not go back.
    void take(const Eigen::Vector3d& position_m, const Eigen::Matrix3d& covariance_m2, Timestamp time) noexcept;

    /// What a fix that is not taken yet differs by from what is expected at its time, and the covariance of that.
    struct Innovation {
        Eigen::Vector3d value_m;
        Eigen::Matrix3d covariance_m2;
    };
    Innovation innovation(const Eigen::Vector3d& position_m, const Eigen::Matrix3d& covariance_m2,
                          Timestamp time) const noexcept;

    /// Forgets all: the next fix starts it anew.
    void stop() noexcept { started_ = false; }
    bool is_started() const noexcept { return started_; }
    Timestamp last_fix() const noexcept { return time_; }

    /// Position, velocity and their covariance at `time`, at or after the last fix.
    void write(Timestamp time, Estimate& estimate) const noexcept;

  private:
    /// Three numbers each: position, velocity, error carried along.
    using State = Eigen::Matrix<double, 9, 1>;
    using Covariance = Eigen::Matrix<double, 9, 9>;

    void start(const Eigen::Vector3d& position_m) noexcept;
    void predict(double dt_s) noexcept;
    int axes() const noexcept { return model_.planar ? 2 : 3; }

    FixFilterModel model_;
    State state_ = State::Zero();
    Covariance covariance_ = Covariance::Zero();
    Eigen::Matrix3d carried_m2_ = Eigen::Matrix3d::Zero(); ///< what the carried error settles at
    Timestamp time_{};
    bool started_ = false;
};

} // namespace locus::filter
