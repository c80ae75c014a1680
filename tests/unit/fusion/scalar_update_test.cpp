// The scalar update against the textbook's matrix form, and its numbers after a million steps.
#include "fusion/filter/scalar_update.h"

#include "tests/support/heavy.h"

#include <gtest/gtest.h>

#include <random>

namespace locus::filter {
namespace {

using Vector = Eigen::Matrix<double, 6, 1>;
using Matrix = Eigen::Matrix<double, 6, 6>;

struct Problem {
    Vector state;
    Matrix covariance;
    Vector jacobian;
};

Problem random_problem(std::mt19937& random) {
    std::normal_distribution<double> normal;
    const auto draw = [&] { return normal(random); };
    const Matrix root = Matrix::NullaryExpr(draw);
    const Matrix square = test::carried(root, Matrix::Identity());
    return {Vector::NullaryExpr(draw), (square + square.transpose()) / 2, Vector::NullaryExpr(draw)};
}

TEST(ScalarUpdate, EqualsTheInformationForm) {
    std::mt19937 random(1);
    for (int trial = 0; trial < 100; ++trial) {
        Problem p = random_problem(random);
        const double innovation = 0.7, variance = 0.09;
        const Matrix information = test::inverse(p.covariance) + p.jacobian * p.jacobian.transpose() / variance;
        const Matrix expected_covariance = test::inverse(information);
        const Vector expected_state = p.state + expected_covariance * p.jacobian * innovation / variance;
        update_scalar(p.state, p.covariance, predict_scalar(p.covariance, p.jacobian), innovation, variance);
        EXPECT_LT((p.state - expected_state).norm(), 1e-6 * (1 + expected_state.norm()));
        EXPECT_LT((p.covariance - expected_covariance).norm(), 1e-6 * (1 + expected_covariance.norm()));
    }
}

TEST(ScalarUpdate, JosephHoldsForAGainThatIsNotKalmans) {
    std::mt19937 random(2);
    Problem p = random_problem(random);
    const double variance = 0.25;
    const Vector gain = 0.3 * p.jacobian;
    const Matrix left = Matrix::Identity() - gain * p.jacobian.transpose();
    const Matrix expected = test::carried(left, p.covariance) + gain * variance * gain.transpose();
    joseph(p.covariance, gain, predict_scalar(p.covariance, p.jacobian), variance);
    EXPECT_LT((p.covariance - expected).norm(), 1e-12 * expected.norm());
}

TEST(ScalarUpdate, APartOfTheCreditIsTheUpdateWithMoreNoise) {
    std::mt19937 random(4);
    Problem p = random_problem(random), noisier = p;
    const double variance = 0.25, share = 0.4;
    const auto prediction = predict_scalar(p.covariance, p.jacobian);
    const double innovation_variance = prediction.state_variance + variance;
    update_scalar(p.state, p.covariance, prediction, 0.7, variance, {share, share});
    update_scalar(noisier.state, noisier.covariance, prediction, 0.7,
                  innovation_variance / share - prediction.state_variance);
    EXPECT_LT((p.state - noisier.state).norm(), 1e-12);
    EXPECT_LT((p.covariance - noisier.covariance).norm(), 1e-12);
}

TEST(ScalarUpdate, MillionStepsKeepTheCovarianceSymmetricAndPositive) {
    std::mt19937 random(3);
    Problem p = random_problem(random);
    p.covariance *= 1e6;
    std::normal_distribution<double> normal;
    for (int step = 0; step < 1'000'000; ++step) {
        for (double& h : p.jacobian) h = normal(random);
        p.covariance.diagonal().array() += 1e-9; // as little noise as any filter here has
        update_scalar(p.state, p.covariance, predict_scalar(p.covariance, p.jacobian), normal(random), 1e-4);
    }
    EXPECT_EQ(p.covariance, Matrix(p.covariance.transpose()));
    const Eigen::VectorXd eigenvalues = test::eigenvalues(p.covariance);
    EXPECT_GT(eigenvalues.minCoeff(), 0);
    EXPECT_LT(eigenvalues.maxCoeff(), 1e-4);
}

} // namespace
} // namespace locus::filter
