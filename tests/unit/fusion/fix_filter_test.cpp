// The filters of positions: the plain one against the textbook, the augmented one against noise of its own model, the
// window of principal components by what it does to a line, a corner and a target at rest.
#include "fusion/filter/fix_filter.h"
#include "fusion/filter/motion.h"
#include "fusion/filter/pca_window.h"
#include "tests/support/heavy.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <utility>

namespace locus::filter::fix_test {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

struct Draw {
    std::mt19937 random;
    std::normal_distribution<double> normal;
    double operator()() { return normal(random); }
    Eigen::Vector3d vector() {
        return Eigen::Vector3d::NullaryExpr([this] { return (*this)(); });
    }
};

Vector6 state_of(const Estimate& e) {
    return (Vector6() << e.position_site_m[0], e.position_site_m[1], e.position_site_m[2], e.velocity_site_mps[0],
            e.velocity_site_mps[1], e.velocity_site_mps[2])
        .finished();
}

Matrix6 transition(double dt) {
    Matrix6 f = Matrix6::Identity();
    f.topRightCorner<3, 3>() = dt * Eigen::Matrix3d::Identity();
    return f;
}

Matrix6 motion_noise(double walk, double dt) {
    Matrix6 q = Matrix6::Zero();
    q.topLeftCorner<3, 3>().diagonal().setConstant(dt * dt * dt / 3);
    q.topRightCorner<3, 3>().diagonal().setConstant(dt * dt / 2);
    q.bottomLeftCorner<3, 3>().diagonal().setConstant(dt * dt / 2);
    q.bottomRightCorner<3, 3>().diagonal().setConstant(dt);
    return walk * walk * q;
}

TEST(FixFilter, PlainIsTheTextbooksFilter) {
    Draw draw{std::mt19937(1), {}};
    FixFilterModel model;
    FixFilter filter(model);
    const Eigen::Matrix3d root{{0.3, 0, 0}, {0.1, 0.2, 0}, {-0.1, 0.05, 0.4}};
    const Eigen::Matrix3d fix_m2 = test::carried(root, Eigen::Matrix3d::Identity());
    Vector6 state = Vector6::Zero();
    Matrix6 covariance = Matrix6::Identity();
    covariance.topLeftCorner<3, 3>() = fix_m2;
    state.head<3>() << 1, 2, 3;
    filter.take(state.head<3>(), fix_m2, timestamp_from_s(1));
    double time_s = 1;
    for (const double dt : {0.1, 0.3, 0.02, 1.0}) {
        const Eigen::Vector3d fix_m = state.head<3>() + draw.vector();
        time_s += dt;
        filter.take(fix_m, fix_m2, timestamp_from_s(time_s));
        const Matrix6 f = transition(dt);
        state = f * state;
        covariance = test::carried(f, covariance) + motion_noise(model.velocity_walk, dt);
        const Eigen::Matrix<double, 6, 3> gain =
            covariance.leftCols<3>() * test::inverse(covariance.topLeftCorner<3, 3>() + fix_m2);
        state += gain * (fix_m - state.head<3>());
        covariance -= gain * covariance.topRows<3>();
    }
    Estimate estimate;
    filter.write(timestamp_from_s(time_s), estimate);
    EXPECT_LT((state_of(estimate) - state).norm(), 1e-5);
    EXPECT_LT((Eigen::Map<const Matrix6>(estimate.covariance.data()) - covariance).norm(), 1e-5);
}

/// NEES of position and velocity after 20 s of fixes whose error is white and coloured in the shares of `truth`.
double nees(const FixFilterModel& truth, const FixFilterModel& believed, unsigned seed) {
    constexpr double dt = 0.1, sigma_m = 0.3;
    Draw draw{std::mt19937(seed), {}};
    const Matrix6 root = motion_noise(truth.velocity_walk, dt).llt().matrixL();
    const WanderStep wander = wander_step(sigma_m * std::sqrt(truth.carried_share), truth.carried_time_s, dt);
    Vector6 state;
    state << 0, 0, 0, draw.vector();
    Eigen::Vector3d carried_m = sigma_m * std::sqrt(truth.carried_share) * draw.vector();
    FixFilter filter(believed);
    Timestamp time{};
    for (int i = 0; i < 200; ++i) {
        const Eigen::Vector3d error_m = carried_m + sigma_m * std::sqrt(1 - truth.carried_share) * draw.vector();
        time = timestamp_from_s(1 + dt * i);
        filter.take(state.head<3>() + error_m, sigma_m * sigma_m * Eigen::Matrix3d::Identity(), time);
        if (i == 199) break;
        Vector6 pushed;
        pushed << draw.vector(), draw.vector();
        state = transition(dt) * state + root * pushed;
        carried_m = wander.keep * carried_m + std::sqrt(wander.variance) * draw.vector();
    }
    Estimate estimate;
    filter.write(time, estimate);
    const Vector6 error = state_of(estimate) - state;
    return test::weighed_square(error, Eigen::Map<const Matrix6>(estimate.covariance.data()));
}

double mean_nees(const FixFilterModel& truth, const FixFilterModel& believed) {
    double sum = 0;
    for (unsigned seed = 1; seed <= 200; ++seed) sum += nees(truth, believed, seed);
    return sum / 200;
}

// The bands are those of the mean of 200 chi-squares of six, 95 %.
TEST(FixFilter, AugmentedIsAsSureAsItMayBeAndThePlainOneIsFoundOut) {
    const double low = test::chi_square_quantile(1200, 0.025) / 200,
                 high = test::chi_square_quantile(1200, 0.975) / 200;
    FixFilterModel white, coloured;
    coloured.carried_share = 0.8;
    coloured.carried_time_s = 1;
    EXPECT_GT(mean_nees(coloured, coloured), low);
    EXPECT_LT(mean_nees(coloured, coloured), high);
    EXPECT_GT(mean_nees(white, white), low);
    EXPECT_LT(mean_nees(white, white), high);
    EXPECT_GT(mean_nees(coloured, white), high);
}

TEST(FixFilter, MillionFixesLeaveTheCovarianceSymmetric) {
    FixFilterModel model;
    model.carried_share = 0.8;
    FixFilter filter(model);
    const Eigen::Matrix3d fix_m2 = 0.01 * Eigen::Matrix3d::Identity();
    for (int i = 0; i < 1'000'000; ++i) filter.take({1, 2, 3}, fix_m2, timestamp_from_s(0.01 * i));
    Estimate estimate;
    filter.write(timestamp_from_s(1e4), estimate);
    const Matrix6 covariance = Eigen::Map<const Matrix6>(estimate.covariance.data());
    EXPECT_LT((covariance - covariance.transpose()).norm(), 1e-15);
    EXPECT_GT(test::eigenvalues(covariance).minCoeff(), 0);
    EXPECT_LT((Eigen::Vector3d(estimate.position_site_m.data()) - Eigen::Vector3d(1, 2, 3)).norm(), 1e-6);
}

TEST(DegradationFactor, IsEquation17) {
    EXPECT_EQ(degradation_factor(0.96), 1);
    EXPECT_DOUBLE_EQ(degradation_factor(0.95), 1 / 0.95);
    EXPECT_DOUBLE_EQ(degradation_factor(0.85), 1 / 0.85);
    EXPECT_DOUBLE_EQ(degradation_factor(0.5), 4);
}

constexpr double fix_sigma_m = 0.2;
const Eigen::Matrix3d fix_m2 = fix_sigma_m * fix_sigma_m * Eigen::Vector3d(1, 1, 0).asDiagonal().toDenseMatrix();

/// The last of `count` noisy fixes, 0.12 m apart along `direction`; and what lies across the way of it.
std::pair<PcaWindow::Denoised, double> walk(PcaWindow& window, Draw& draw, const Eigen::Vector3d& from_m,
                                            const Eigen::Vector3d& direction, int count) {
    PcaWindow::Denoised denoised;
    Eigen::Vector3d truth_m = from_m;
    for (int i = 0; i < count; ++i) {
        truth_m = from_m + 0.12 * i * direction;
        const Eigen::Vector3d fix_m = truth_m + fix_sigma_m * Eigen::Vector3d(draw(), draw(), 0);
        denoised = window.take(fix_m, fix_m2);
    }
    const Eigen::Vector3d error_m = denoised.position_m - truth_m;
    return {denoised, (error_m - direction * direction.dot(error_m)).norm()};
}

TEST(PcaWindow, TakesOffWhatLiesAcrossAStraightWalkInAnyDirection) {
    for (const double angle : {0.0, 0.7, 1.5708, 2.4}) {
        const Eigen::Vector3d direction(std::cos(angle), std::sin(angle), 0);
        double squares = 0;
        for (unsigned seed = 1; seed <= 200; ++seed) {
            Draw draw{std::mt19937(seed), {}};
            PcaWindow window({100, 2}); // one that chance does not cut
            const auto [denoised, across_m] = walk(window, draw, {1, 2, 1.5}, direction, 100);
            EXPECT_GT(denoised.energy_ratio, 0.95);
            EXPECT_EQ(denoised.degradation, 1);
            EXPECT_EQ(denoised.position_m.z(), 1.5);
            squares += across_m * across_m;
        }
        // The end of a line fitted to n points has the variance 4 sigma^2 / n.
        EXPECT_NEAR(std::sqrt(squares / 200), 2 * fix_sigma_m / std::sqrt(100.0), 0.01) << angle;
    }
}

TEST(PcaWindow, LetsGoOfTheWayBeforeACorner) {
    Draw draw{std::mt19937(3), {}};
    PcaWindow window({100, 1.3});
    walk(window, draw, {0, 0, 0}, Eigen::Vector3d::UnitX(), 100);
    const auto [denoised, across_m] = walk(window, draw, {12, 0, 0}, Eigen::Vector3d::UnitY(), 40);
    EXPECT_LT(denoised.length, 60);
    EXPECT_LT(across_m, 0.2);
}

TEST(PcaWindow, LeavesATargetAtRestAsItIsAndBelievesItLess) {
    Draw draw{std::mt19937(4), {}};
    PcaWindow window({100, 1.3});
    PcaWindow::Denoised denoised;
    Eigen::Vector3d fix_m;
    for (int i = 0; i < 100; ++i) {
        fix_m = fix_sigma_m * Eigen::Vector3d(draw(), draw(), 0);
        denoised = window.take(fix_m, fix_m2);
    }
    EXPECT_EQ(denoised.position_m, fix_m);
    EXPECT_LT(denoised.energy_ratio, 0.85);
    EXPECT_GT(denoised.degradation, 1.3);
}

} // namespace
} // namespace locus::filter::fix_test
