#include "fusion/vision/scale/six_state.h"

#include <Eigen/LU>

#include <cmath>

namespace locus::vision {

SixState::SixState(const SixStateModel& model, const State& start, double place_sigma_m)
    : model_(model), state_(start), covariance_(Covariance::Zero()) {
    const State sigma{place_sigma_m,
                      place_sigma_m,
                      model.start_speed_mps,
                      model.start_heading_rad,
                      model.start_scale * start(scale_at),
                      model.start_deflection_rad};
    covariance_.diagonal() = sigma.cwiseAbs2();
}

void SixState::predict(double dt_s) {
    const double speed_mps = state_(speed_at), sine = std::sin(state_(heading_at)),
                 cosine = std::cos(state_(heading_at));
    Covariance transition = Covariance::Identity();
    transition(x_at, speed_at) = sine * dt_s;
    transition(y_at, speed_at) = cosine * dt_s;
    transition(x_at, heading_at) = speed_mps * cosine * dt_s;
    transition(y_at, heading_at) = -speed_mps * sine * dt_s;
    state_(x_at) += speed_mps * sine * dt_s;
    state_(y_at) += speed_mps * cosine * dt_s;
    const State walk{0,
                     0,
                     model_.speed_walk_mps2,
                     model_.heading_walk_rads,
                     model_.scale_walk * state_(scale_at),
                     model_.deflection_walk_rads};
    covariance_ = (transition * covariance_ * transition.transpose()).eval();
    covariance_.diagonal() += dt_s * walk.cwiseAbs2();
}

void SixState::hear(const Eigen::Vector2d& place_site_m, double sigma_m) {
    Eigen::Matrix<double, 2, 6> jacobian = Eigen::Matrix<double, 2, 6>::Zero();
    jacobian.leftCols<2>().setIdentity();
    update(place_site_m - state_.head<2>(), jacobian, sigma_m);
}

/// What is compared is the place: x, y = begin + scale R(deflection) vision.
void SixState::see(const Eigen::Vector2d& since_begin_odometry, const Eigen::Vector2d& begin_site_m, double sigma_m) {
    const double sine = std::sin(state_(deflection_at)), cosine = std::cos(state_(deflection_at));
    const Eigen::Matrix2d turn{{cosine, -sine}, {sine, cosine}}, quarter{{0, -1}, {1, 0}};
    const Eigen::Vector2d turned = turn * since_begin_odometry;
    const Eigen::Vector2d seen_m = begin_site_m + state_(scale_at) * turned;
    Eigen::Matrix<double, 2, 6> jacobian = Eigen::Matrix<double, 2, 6>::Zero();
    jacobian.leftCols<2>() = -Eigen::Matrix2d::Identity();
    jacobian.col(scale_at) = turned;
    jacobian.col(deflection_at) = state_(scale_at) * (quarter * turned);
    update(state_.head<2>() - seen_m, jacobian, sigma_m); // the difference of both should be nothing
}

void SixState::update(const Eigen::Vector2d& innovation_m, const Eigen::Matrix<double, 2, 6>& jacobian,
                      double sigma_m) {
    const Eigen::Matrix2d noise_m2 = sigma_m * sigma_m * Eigen::Matrix2d::Identity();
    const Eigen::Matrix2d expected_m2 = jacobian * covariance_ * jacobian.transpose() + noise_m2;
    const Eigen::Matrix<double, 6, 2> gain = covariance_ * jacobian.transpose() * expected_m2.inverse();
    state_ += gain * innovation_m;
    const Covariance rest = Covariance::Identity() - gain * jacobian;
    covariance_ = (rest * covariance_ * rest.transpose() + gain * noise_m2 * gain.transpose()).eval();
}

} // namespace locus::vision
