// Posterior Cramer-Rao bound of a walker on a plane, whose velocity wanders (white acceleration) and who hears ranges
// (Tichavsky, Muravchik, Nehorai 1998, eq. 21 for linear motion): J+ = (Q + F J^-1 F')^-1 + E[H'H] / sigma^2, with the
// expectation over walks drawn from the model. The mean of efficient filters' squared errors cannot be below it.
#pragma once

#include <Eigen/Dense>

#include <random>
#include <vector>

namespace locus::test {

using Anchors2 = std::vector<Eigen::Vector2d>;

struct WanderingWalk {
    double dt_s = 0.1;
    double wander_mps_rts = 0.5;
    double range_sigma_m = 0.1;
    double speed_sigma_mps = 0.5;
    int epochs = 100;

    Eigen::Matrix4d transition() const {
        Eigen::Matrix4d f = Eigen::Matrix4d::Identity();
        f.topRightCorner<2, 2>().diagonal().setConstant(dt_s);
        return f;
    }
    Eigen::Matrix4d noise() const {
        const double q = wander_mps_rts * wander_mps_rts;
        Eigen::Matrix4d n = Eigen::Matrix4d::Zero();
        n.topLeftCorner<2, 2>().diagonal().setConstant(q * dt_s * dt_s * dt_s / 3);
        n.topRightCorner<2, 2>().diagonal().setConstant(q * dt_s * dt_s / 2);
        n.bottomLeftCorner<2, 2>() = n.topRightCorner<2, 2>();
        n.bottomRightCorner<2, 2>().diagonal().setConstant(q * dt_s);
        return n;
    }
    /// A state per epoch, from `start_m` with a drawn velocity.
    std::vector<Eigen::Vector4d> draw(const Eigen::Vector2d& start_m, std::mt19937& random) const {
        std::normal_distribution<double> normal;
        const auto noise_of = [&] { return Eigen::Vector4d::NullaryExpr([&] { return normal(random); }).eval(); };
        const Eigen::Matrix4d root = noise().llt().matrixL(), f = transition();
        Eigen::Vector4d state;
        state << start_m, speed_sigma_mps * normal(random), speed_sigma_mps * normal(random);
        std::vector<Eigen::Vector4d> states;
        for (int i = 0; i < epochs; ++i) states.push_back(state = f * state + root * noise_of());
        return states;
    }
};

/// Mean over the second half of the walk of the bound on the squared position error, m^2; the position of epoch 0 is
/// known as well as one epoch of ranges tells it.
inline double bound_m2(const WanderingWalk& walk, const Anchors2& anchors,
                       const std::vector<std::vector<Eigen::Vector4d>>& walks) {
    Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
    information.bottomRightCorner<2, 2>().diagonal().setConstant(1 / (walk.speed_sigma_mps * walk.speed_sigma_mps));
    double sum = 0;
    for (int epoch = 0; epoch < walk.epochs; ++epoch) {
        if (epoch > 0)
            information = (walk.noise() + walk.transition() * information.inverse() * walk.transition().transpose())
                              .inverse()
                              .eval();
        for (const auto& states : walks)
            for (const Eigen::Vector2d& anchor : anchors) {
                const Eigen::Vector2d sight =
                    (states[static_cast<std::size_t>(epoch)].head<2>() - anchor).normalized() / walk.range_sigma_m;
                information.topLeftCorner<2, 2>() += sight * sight.transpose() / static_cast<double>(walks.size());
            }
        if (2 * epoch >= walk.epochs) sum += information.inverse().topLeftCorner<2, 2>().trace();
    }
    return sum / (walk.epochs - walk.epochs / 2);
}

} // namespace locus::test
