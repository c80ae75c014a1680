#include "fusion/filter/fix_filter.h"

#include "fusion/filter/motion.h"
#include "fusion/filter/scalar_update.h"

#include <Eigen/Cholesky>

#include <algorithm>

namespace locus::filter {

void FixFilter::start(const Eigen::Vector3d& position_m) noexcept {
    state_.setZero();
    state_.head<3>() = position_m;
    covariance_.setZero();
    for (int i = 0; i < axes(); ++i) {
        covariance_(i, i) = 1e8; // nothing is known before the first fix is taken in
        covariance_(3 + i, 3 + i) = model_.start_speed_sigma_mps * model_.start_speed_sigma_mps;
    }
    covariance_.bottomRightCorner<3, 3>() = carried_m2_;
    started_ = true;
}

void FixFilter::predict(double dt_s) noexcept {
    const WanderStep wander = wander_step(1, model_.carried_time_s, dt_s);
    state_.head<3>() += dt_s * state_.segment<3>(3);
    state_.tail<3>() *= wander.keep;
    covariance_.topRows<3>() += dt_s * covariance_.middleRows<3>(3);
    covariance_.leftCols<3>() += dt_s * covariance_.middleCols<3>(3);
    covariance_.bottomRows<3>() *= wander.keep;
    covariance_.rightCols<3>() *= wander.keep;
    const double power = model_.velocity_walk * model_.velocity_walk * dt_s;
    for (int i = 0; i < axes(); ++i) {
        covariance_(i, i) += power * dt_s * dt_s / 3;
        covariance_(i, 3 + i) += power * dt_s / 2;
        covariance_(3 + i, i) += power * dt_s / 2;
        covariance_(3 + i, 3 + i) += power;
    }
    covariance_.bottomRightCorner<3, 3>() += wander.variance * carried_m2_;
}

/// Coordinates of a fix have errors in common; divided by the Cholesky factor they are free of each other, and go in
/// one at a time.
void FixFilter::take(const Eigen::Vector3d& position_m, const Eigen::Matrix3d& covariance_m2, Timestamp time) noexcept {
    const int n = axes();
    carried_m2_ = model_.carried_share * covariance_m2;
    if (started_)
        predict(std::max(0.0, to_s(time - time_)));
    else
        start(position_m);
    time_ = time;
    Eigen::Matrix3d fresh_m2 = Eigen::Matrix3d::Identity();
    fresh_m2.topLeftCorner(n, n) = (1 - model_.carried_share) * covariance_m2.topLeftCorner(n, n);
    const Eigen::Matrix3d root = fresh_m2.llt().matrixL();
    const Eigen::Matrix3d whiten = root.triangularView<Eigen::Lower>().solve(Eigen::Matrix3d::Identity());
    for (int i = 0; i < n; ++i) {
        State jacobian = State::Zero();
        jacobian.head(n) = whiten.row(i).head(n);
        jacobian.tail<3>().head(n) = whiten.row(i).head(n);
        const double innovation = whiten.row(i).head(n).dot(position_m.head(n)) - jacobian.dot(state_);
        update_scalar(state_, covariance_, predict_scalar(covariance_, jacobian), innovation, 1.0);
    }
}

FixFilter::Innovation FixFilter::innovation(const Eigen::Vector3d& position_m, const Eigen::Matrix3d& covariance_m2,
                                            Timestamp time) const noexcept {
    FixFilter ahead = *this;
    ahead.carried_m2_ = model_.carried_share * covariance_m2;
    ahead.predict(std::max(0.0, to_s(time - time_)));
    Eigen::Matrix<double, 3, 9> seen = Eigen::Matrix<double, 3, 9>::Zero();
    seen.leftCols<3>().setIdentity();
    seen.rightCols<3>().setIdentity();
    return {position_m - seen * ahead.state_,
            seen * ahead.covariance_ * seen.transpose() + (1 - model_.carried_share) * covariance_m2};
}

void FixFilter::write(Timestamp time, Estimate& estimate) const noexcept {
    FixFilter ahead = *this;
    ahead.predict(std::max(0.0, to_s(time - time_)));
    Eigen::Map<Eigen::Vector3d>(estimate.position_site_m.data()) = ahead.state_.head<3>();
    Eigen::Map<Eigen::Vector3d>(estimate.velocity_site_mps.data()) = ahead.state_.segment<3>(3);
    Eigen::Map<Eigen::Matrix<double, 6, 6>>(estimate.covariance.data()) = ahead.covariance_.topLeftCorner<6, 6>();
}

} // namespace locus::filter
