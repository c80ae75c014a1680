// State and covariance of a filter whose first numbers are its core (motion, attitude, biases of the inertial sensor)
// and behind them the errors that its sources carry along from one measurement to the next. The error of a UWB range is
// not white: antenna, body and multipath hold it for as long as the pose hardly changes. A filter that calls it white
// believes that a hundred repetitions of one error are a hundred opinions; kept as states that wander, they leave the
// bound honest.
#pragma once

#include "fusion/filter/motion.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstdint>

namespace locus::filter {

/// An error that wanders about zero (Gauss-Markov); constant when `time_s` is infinite.
struct WanderModel {
    double sigma = 0;
    double time_s = 1;
    bool operator==(const WanderModel&) const = default;
};

/// `MaxCore`: room for the core, which always begins with position, velocity and a third number of each axis.
template <int MaxCore, int MaxWanderers = 24>
class WanderingState {
  public:
    static constexpr int max_wanderers = MaxWanderers;
    static constexpr int max_size = MaxCore + max_wanderers;
    using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, max_size, 1>;
    using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, max_size, max_size>;

    using CoreMap = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, MaxCore, MaxCore>;

    explicit WanderingState(int core) noexcept
        : state(Vector::Zero(core)), covariance(Matrix::Zero(core, core)), core_(core) {}

    /// Place in the state of the wanderer called `key`. One not met lately begins at its own sigma, and where there is
    /// no room takes the place of the one that was asked for longest ago.
    int wanderer(std::int32_t key, const WanderModel& model) noexcept;

    /// The wanderer called `key`, which there is or none: -1.
    int known_wanderer(std::int32_t key) const noexcept;
    /// It becomes a copy of `value`, a number that the state tells with the gradient `jacobian`: from now on it stays
    /// what it is and knows how it hangs together with all others (stochastic cloning: Roumeliotis and Burdick 2002).
    void become_copy(int wanderer, double value, const Vector& jacobian) noexcept;

    /// Whether the numbers of both mean the same.
    bool is_laid_out_as(const WanderingState& other) const noexcept {
        const auto known = wanderers_.begin() + (size() - core_);
        return core_ == other.core_ && size() == other.size() &&
               std::equal(wanderers_.begin(), known, other.wanderers_.begin(),
                          [](const Wanderer& a, const Wanderer& b) { return a.key == b.key; });
    }

    static constexpr int place(int axis, int order) { return 3 * axis + order; } ///< order 0 m, 1 m/s, 2: the third
    int size() const noexcept { return static_cast<int>(state.size()); }
    int core() const noexcept { return core_; }
    Eigen::Vector3d position_m() const noexcept { return {state(0), state(3), state(6)}; }

    Vector state;
    Matrix covariance; ///< symmetric to the bit

  protected:
    /// All wanderers are forgotten, the core is zero.
    void clear(int core) noexcept;
    /// What `dt_s` does to the wanderers. `move(column, keep)` moves the covariance of the core with one that keeps
    /// `keep` of itself. The lower triangle follows the upper.
    template <class Move>
    void wander(const Move& move, double dt_s) noexcept;
    /// The core becomes another one, whose error is `map` times the error of this one; the wanderers stay as they are.
    /// The state of the new core is zero where the caller does not fill it.
    void change_core(const CoreMap& map) noexcept;

  private:
    struct Wanderer {
        std::int32_t key = 0;
        WanderModel model;
        std::uint64_t asked = 0;
    };
    int claim() noexcept;

    int core_;
    std::array<Wanderer, max_wanderers> wanderers_{};
    std::uint64_t asked_ = 0;
};

template <int MaxCore, int MaxWanderers>
void WanderingState<MaxCore, MaxWanderers>::clear(int core) noexcept {
    core_ = core;
    state.setZero(core);
    covariance.setZero(core, core);
}

template <int MaxCore, int MaxWanderers>
template <class Move>
void WanderingState<MaxCore, MaxWanderers>::wander(const Move& move, double dt_s) noexcept {
    std::array<WanderStep, max_wanderers> steps; // the errors of all anchors are alike: most steps are known already
    for (int k = core_; k < size(); ++k) {
        const auto here = wanderers_.begin() + (k - core_);
        const auto like =
            std::find_if(wanderers_.begin(), here, [&](const Wanderer& w) { return w.model == here->model; });
        const WanderStep step =
            like != here ? steps[like - wanderers_.begin()] : wander_step(here->model.sigma, here->model.time_s, dt_s);
        steps[k - core_] = step;
        state(k) *= step.keep;
        move(covariance.col(k).head(core_), step.keep);
        covariance.col(k).segment(core_, k - core_) *= step.keep;
        covariance.row(k).tail(size() - k) *= step.keep;
        covariance(k, k) = covariance(k, k) * step.keep + step.variance;
    }
    for (int k = 0; k < size(); ++k)
        for (int i = 0; i < k; ++i) covariance(k, i) = covariance(i, k);
}

template <int MaxCore, int MaxWanderers>
void WanderingState<MaxCore, MaxWanderers>::change_core(const CoreMap& map) noexcept {
    const int now = core_, then = static_cast<int>(map.rows()), wanderers = size() - core_;
    const Matrix before = covariance;
    const Vector state_before = state;
    clear(then);
    state.conservativeResizeLike(Vector::Zero(then + wanderers));
    covariance.conservativeResizeLike(Matrix::Zero(then + wanderers, then + wanderers));
    state.tail(wanderers) = state_before.tail(wanderers);
    covariance.topLeftCorner(then, then) = map * before.topLeftCorner(now, now).lazyProduct(map.transpose());
    covariance.topRightCorner(then, wanderers) = map.lazyProduct(before.topRightCorner(now, wanderers));
    covariance.bottomRightCorner(wanderers, wanderers) = before.bottomRightCorner(wanderers, wanderers);
    covariance.template triangularView<Eigen::StrictlyLower>() = covariance.transpose();
}

template <int MaxCore, int MaxWanderers>
int WanderingState<MaxCore, MaxWanderers>::claim() noexcept {
    if (size() - core_ < max_wanderers) {
        const int k = size();
        state.conservativeResize(k + 1);
        covariance.conservativeResize(k + 1, k + 1);
        return k;
    }
    const auto oldest = std::min_element(wanderers_.begin(), wanderers_.end(),
                                         [](const Wanderer& a, const Wanderer& b) { return a.asked < b.asked; });
    return core_ + static_cast<int>(oldest - wanderers_.begin());
}

template <int MaxCore, int MaxWanderers>
int WanderingState<MaxCore, MaxWanderers>::known_wanderer(std::int32_t key) const noexcept {
    const auto known = wanderers_.begin() + (size() - core_);
    const auto found = std::find_if(wanderers_.begin(), known, [&](const Wanderer& w) { return w.key == key; });
    return found == known ? -1 : core_ + static_cast<int>(found - wanderers_.begin());
}

template <int MaxCore, int MaxWanderers>
void WanderingState<MaxCore, MaxWanderers>::become_copy(int wanderer, double value, const Vector& jacobian) noexcept {
    Vector cross = Vector::Zero(size());
    for (int i = 0; i < size(); ++i)
        if (jacobian(i) != 0) cross += jacobian(i) * covariance.col(i);
    const double variance = jacobian.dot(cross);
    state(wanderer) = value;
    covariance.col(wanderer) = cross;
    covariance.row(wanderer) = cross.transpose();
    covariance(wanderer, wanderer) = variance;
}

template <int MaxCore, int MaxWanderers>
int WanderingState<MaxCore, MaxWanderers>::wanderer(std::int32_t key, const WanderModel& model) noexcept {
    if (const int known = known_wanderer(key); known >= 0) {
        wanderers_[known - core_].asked = ++asked_;
        return known;
    }
    const int k = claim();
    wanderers_[k - core_] = {key, model, ++asked_};
    state(k) = 0;
    covariance.row(k).setZero();
    covariance.col(k).setZero();
    covariance(k, k) = model.sigma * model.sigma;
    return k;
}

} // namespace locus::filter
