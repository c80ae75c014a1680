#include "fusion/filter/track_state.h"

#include <algorithm>

namespace locus::filter {

void TrackState::start(const Eigen::Vector3d& position_m, const Eigen::Matrix3d& covariance_m2) noexcept {
    state.setZero(motion_size);
    covariance.setZero(motion_size, motion_size);
    const int axes = model_.planar ? 2 : 3;
    for (int i = 0; i < 3; ++i) state(place(i, 0)) = position_m(i);
    for (int i = 0; i < axes; ++i) {
        for (int j = 0; j < axes; ++j) covariance(place(i, 0), place(j, 0)) = covariance_m2(i, j);
        covariance(place(i, 1), place(i, 1)) = model_.start_speed_sigma_mps * model_.start_speed_sigma_mps;
        covariance(place(i, 2), place(i, 2)) =
            model_.motion.acceleration_sigma_mps2 * model_.motion.acceleration_sigma_mps2;
    }
}

namespace {

/// F x for the transition F of axis_step(): the numbers below its diagonal are zero and the upper two on it are one.
template <class Numbers>
void advance(const Eigen::Matrix3d& transition, Numbers&& position, Numbers&& velocity, Numbers&& acceleration) {
    position += transition(0, 1) * velocity + transition(0, 2) * acceleration;
    velocity += transition(1, 2) * acceleration;
    acceleration *= transition(2, 2);
}

} // namespace

/// F P F' in the upper half: first P F', column by column, then F from the left, three numbers of a column at a time.
void TrackState::predict(double dt_s) noexcept {
    if (dt_s == 0) return;
    const AxisStep step = axis_step(model_.motion, dt_s);
    const int axes = model_.planar ? 2 : 3;
    const auto motion = [this](int column) { return covariance.col(column).head<motion_size>(); };
    for (int i = 0; i < motion_size; i += 3) {
        advance(step.transition, state(i), state(i + 1), state(i + 2));
        advance(step.transition, motion(i), motion(i + 1), motion(i + 2));
    }
    for (int k = motion_size; k < size(); ++k) wander(k, dt_s);
    for (int k = 0; k < size(); ++k)
        for (int i = 0; i < std::min(k + 1, motion_size); i += 3)
            advance(step.transition, covariance(i, k), covariance(i + 1, k), covariance(i + 2, k));
    for (int i = 0; i < axes; ++i) covariance.block<3, 3>(3 * i, 3 * i) += step.noise;
    for (int k = 0; k < size(); ++k)
        for (int i = 0; i < k; ++i) covariance(k, i) = covariance(i, k);
}

/// One number that wanders: its column down to itself, and its row beyond.
void TrackState::wander(int k, double dt_s) noexcept {
    const WanderModel& model = wanderers_[static_cast<std::size_t>(k - motion_size)].model;
    const WanderStep by = wander_step(model.sigma, model.time_s, dt_s);
    state(k) *= by.keep;
    covariance.col(k).head(k) *= by.keep;
    covariance.row(k).tail(size() - k) *= by.keep;
    covariance(k, k) = covariance(k, k) * by.keep + by.variance;
}

int TrackState::claim() noexcept {
    if (size() < max_size) {
        const int k = size();
        state.conservativeResize(k + 1);
        covariance.conservativeResize(k + 1, k + 1);
        return k;
    }
    const auto oldest = std::min_element(wanderers_.begin(), wanderers_.end(),
                                         [](const Wanderer& a, const Wanderer& b) { return a.asked < b.asked; });
    return motion_size + static_cast<int>(oldest - wanderers_.begin());
}

int TrackState::wanderer(std::int32_t key, const WanderModel& model) noexcept {
    const auto known = wanderers_.begin() + (size() - motion_size);
    const auto found = std::find_if(wanderers_.begin(), known, [&](const Wanderer& w) { return w.key == key; });
    if (found != known) {
        found->asked = ++asked_;
        return motion_size + static_cast<int>(found - wanderers_.begin());
    }
    const int k = claim();
    wanderers_[k - motion_size] = {key, model, ++asked_};
    state(k) = 0;
    covariance.row(k).setZero();
    covariance.col(k).setZero();
    covariance(k, k) = model.sigma * model.sigma;
    return k;
}

Eigen::Matrix3d TrackState::position_covariance_m2() const noexcept {
    Eigen::Matrix3d result;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) result(i, j) = covariance(place(i, 0), place(j, 0));
    return result;
}

} // namespace locus::filter
