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

void TrackState::predict(double dt_s) noexcept {
    // The transition is one 3 x 3 block three times and a diagonal, so the products are taken block by block.
    const AxisStep step = axis_step(model_.motion, dt_s);
    const int axes = model_.planar ? 2 : 3;
    for (int i = 0; i < 3; ++i) state.segment<3>(3 * i) = (step.transition * state.segment<3>(3 * i)).eval();
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i <= j; ++i)
            covariance.block<3, 3>(3 * i, 3 * j) =
                (step.transition * covariance.block<3, 3>(3 * i, 3 * j) * step.transition.transpose()).eval();
    for (int i = 0; i < axes; ++i) covariance.block<3, 3>(3 * i, 3 * i) += step.noise;

    for (int k = motion_size; k < size(); ++k) {
        const WanderModel& wander = wanderers_[k - motion_size].model;
        const WanderStep wander_by = wander_step(wander.sigma, wander.time_s, dt_s);
        state(k) *= wander_by.keep;
        for (int i = 0; i < 3; ++i)
            covariance.block<3, 1>(3 * i, k) =
                (step.transition * covariance.block<3, 1>(3 * i, k) * wander_by.keep).eval();
        covariance.col(k).segment(motion_size, k - motion_size) *= wander_by.keep;
        covariance.row(k).tail(size() - k) *= wander_by.keep;
        covariance(k, k) = covariance(k, k) * wander_by.keep + wander_by.variance;
    }
    covariance.triangularView<Eigen::StrictlyLower>() = covariance.transpose();
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
