#include "fusion/filter/motion.h"

#include <array>
#include <cmath>

namespace locus::filter {
namespace {

/// What an acceleration of 1 has done to (position, velocity, acceleration) after `dt_s`.
Eigen::Vector3d response(double time_s, double dt_s) {
    const double x = dt_s / time_s;
    const double gone = -std::expm1(-x);
    return {time_s * time_s * (x - gone), time_s * gone, 1 - gone};
}

struct Node {
    double place, weight;
};
/// Gauss-Legendre nodes on 0..1. A sum of outer products is positive semi-definite whatever the step; the closed form
/// of Singer's Q cancels to nothing for the steps of a millisecond that UWB brings.
constexpr std::array<Node, 4> nodes{{{0.06943184420297371, 0.17392742256872693},
                                     {0.33000947820757187, 0.32607257743127307},
                                     {0.66999052179242813, 0.32607257743127307},
                                     {0.93056815579702629, 0.17392742256872693}}};

} // namespace

AxisStep axis_step(const MotionModel& model, double dt_s) noexcept {
    AxisStep step;
    step.transition << 1, dt_s, 0, 0, 1, 0, 0, 0, 0;
    step.transition.col(2) = response(model.acceleration_time_s, dt_s);
    step.noise.setZero();
    const double sigma = model.acceleration_sigma_mps2;
    const double power = 2 * sigma * sigma * dt_s / model.acceleration_time_s;
    for (const Node& node : nodes) {
        const Eigen::Vector3d pushed =
            std::sqrt(node.weight * power) * response(model.acceleration_time_s, node.place * dt_s);
        step.noise += pushed * pushed.transpose();
    }
    return step;
}

WanderStep wander_step(double sigma, double time_s, double dt_s) noexcept {
    const double x = dt_s / time_s;
    return {std::exp(-x), -sigma * sigma * std::expm1(-2 * x)};
}

} // namespace locus::filter
