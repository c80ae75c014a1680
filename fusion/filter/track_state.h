// What a range filter knows of one target: nine numbers of motion (paper 001 eq. 1) and beside them the errors that its
// sources carry along from one measurement to the next. The error of a UWB range is not white: antenna, body and
// multipath hold it for as long as the pose hardly changes. A filter that calls it white believes that a hundred
// repetitions of one error are a hundred opinions; kept as states that wander, they leave the bound honest.
#pragma once

#include "fusion/filter/motion.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>

namespace locus::filter {

/// An error that wanders about zero (Gauss-Markov); constant when `time_s` is infinite.
struct WanderModel {
    double sigma = 0;
    double time_s = 1;
};

struct TrackModel {
    MotionModel motion;
    double start_speed_sigma_mps = 1;
    bool planar = false; ///< the height is known: nothing moves it
};

class TrackState {
  public:
    static constexpr int motion_size = 9;
    static constexpr int max_wanderers = 12;
    static constexpr int max_size = motion_size + max_wanderers;
    using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_size, 1>;
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_size, max_size>;

    explicit TrackState(const TrackModel& model) noexcept : model_(model) {}

    /// At rest at `position_m` with covariance in m^2; all wanderers are forgotten.
    void start(const Eigen::Vector3d& position_m, const Eigen::Matrix3d& covariance_m2) noexcept;

    /// Paper 001 eq. 4 and 8; `dt_s` >= 0.
    void predict(double dt_s) noexcept;

    /// Place in the state of the wanderer called `key`. One not met lately begins at its own sigma, and where there is
    /// no room takes the place of the one that was asked for longest ago.
    int wanderer(std::int32_t key, const WanderModel& model) noexcept;

    static constexpr int place(int axis, int order) { return 3 * axis + order; } ///< order 0 m, 1 m/s, 2 m/s^2
    int size() const noexcept { return static_cast<int>(state.size()); }
    Eigen::Vector3d position_m() const noexcept { return {state(0), state(3), state(6)}; }
    Eigen::Matrix3d position_covariance_m2() const noexcept;

    Vector state = Vector::Zero(motion_size);
    Matrix covariance = Matrix::Zero(motion_size, motion_size); ///< symmetric to the bit

  private:
    struct Wanderer {
        std::int32_t key = 0;
        WanderModel model;
        std::uint64_t asked = 0;
    };
    int claim() noexcept;
    void wander(int k, double dt_s) noexcept;

    TrackModel model_;
    std::array<Wanderer, max_wanderers> wanderers_{};
    std::uint64_t asked_ = 0;
};

} // namespace locus::filter
