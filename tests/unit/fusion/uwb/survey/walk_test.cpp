// Range biases from simulated walks: found within what the calibration says of itself, and not pretended where a tag
// that stands still tells none.
#include "fusion/uwb/survey/correlation.h"
#include "fusion/uwb/survey/walk.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace locus::uwb::survey {
namespace {

using Anchors = Eigen::Matrix<double, Eigen::Dynamic, 3>;

Anchors room() {
    Anchors at_m(6, 3);
    at_m << 0, 0, 0.3, 12, 0, 2.8, 12, 9, 0.4, 0, 9, 2.7, 6, 0, 2.9, 6, 9, 0.3;
    return at_m;
}

/// A walk through the room at walking pace, the tag held high and low; 10 Hz an anchor.
class SimulatedWalk {
  public:
    explicit SimulatedWalk(unsigned seed, double size = 1) : random_{seed}, bias_m(6), size_{size} {
        const double common_m = 0.3 * normal_(random_);
        for (auto& one_m : bias_m) one_m = common_m + 0.2 * normal_(random_);
    }

    Eigen::Vector3d at(double time_s) const {
        const double angle = 2 * std::numbers::pi * time_s / 30;
        const Eigen::Vector3d swing_m(4.5 * std::cos(angle), 3.2 * std::sin(angle), 0.5 * std::sin(7 * angle / 2));
        return Eigen::Vector3d(6, 4.5, 1.3) + size_ * swing_m;
    }

    /// Noise of 0.1 m, and an error of each anchor that stays for 0.3 s, as the settings have it.
    std::vector<WalkRange> ranges(double duration_s) {
        const WalkSettings s;
        std::vector<WalkRange> all;
        const Anchors anchors_m = room();
        Eigen::VectorXd held_m = Eigen::VectorXd::NullaryExpr(6, [&] { return s.held_error_m * normal_(random_); });
        const double step_s = 0.1, keep = std::exp(-step_s / s.held_error_s);
        for (double time_s = 0; time_s < duration_s; time_s += step_s)
            for (std::size_t i = 0; i < 6; ++i) {
                const auto row = static_cast<Eigen::Index>(i);
                held_m(row) = keep * held_m(row) + std::sqrt(1 - keep * keep) * s.held_error_m * normal_(random_);
                const double when_s = time_s + 0.015 * static_cast<double>(i);
                const double true_m = (at(when_s) - anchors_m.row(row).transpose()).norm();
                all.push_back({when_s, i, true_m + bias_m(row) + held_m(row) + 0.1 * normal_(random_), 0.1});
            }
        return all;
    }

  private:
    std::mt19937 random_;
    std::normal_distribution<double> normal_;

  public:
    Eigen::VectorXd bias_m;

  private:
    double size_;
};

// Of 30 walks the squared errors over their covariance, 6 biases each, have a mean of 6 +- 2.6 sqrt(12 / 30) = 1.6.
// Biases are drawn a little closer together than the prior has them, so the calibration may be 25 % more careful than
// that.
TEST(WalkBias, IsAsSureAsItSays) {
    double sum = 0, squares = 0;
    constexpr int walks = 12;
    for (unsigned seed = 0; seed < walks; ++seed) {
        SimulatedWalk walk(seed);
        const Biases found = biases_of_walk(room(), walk.ranges(40), {});
        ASSERT_TRUE(found.solved);
        const Eigen::VectorXd error_m = found.bias_m - walk.bias_m;
        sum += error_m.dot(found.covariance.ldlt().solve(error_m));
        squares += error_m.squaredNorm() / 6;
    }
    std::printf("mean of 6 squared errors over their covariance: %.2f; root mean square error %.3f m\n", sum / walks,
                std::sqrt(squares / walks));
    EXPECT_LE(sum / walks, 8.6);
    EXPECT_GE(sum / walks, 0.75 * 3.4);
    EXPECT_LE(std::sqrt(squares / walks), 0.1);
}

TEST(WalkBias, BlockedRangesDoLittle) {
    SimulatedWalk walk(5);
    auto ranges = walk.ranges(60);
    std::mt19937 random(6);
    std::uniform_real_distribution<double> uniform;
    for (WalkRange& range : ranges)
        if (uniform(random) < 0.1) range.range_m += 1 + 4 * uniform(random);
    const Biases found = biases_of_walk(room(), ranges, {});
    for (Eigen::Index i = 0; i < 6; ++i)
        EXPECT_LT(std::abs(found.bias_m(i) - walk.bias_m(i)), 4 * found.sigma_m(i)) << i;
}

TEST(WalkBias, ATagThatStandsStillTellsNoBiasOfItsOwn) {
    SimulatedWalk still(3, 0.01);
    const WalkSettings settings;
    const Biases found = biases_of_walk(room(), still.ranges(60), settings);
    ASSERT_TRUE(found.solved);
    for (Eigen::Index i = 0; i < 6; ++i) {
        EXPECT_GT(found.sigma_m(i), settings.own_prior_m / 2) << i;
        EXPECT_LT(std::abs(found.bias_m(i) - still.bias_m(i)), 3 * found.sigma_m(i)) << i;
    }
}

TEST(WalkBias, AnAnchorThatIsNotHeardKeepsThePrior) {
    SimulatedWalk walk(1);
    auto ranges = walk.ranges(40);
    std::erase_if(ranges, [](const auto& range) { return range.anchor == 2; });
    const Biases found = biases_of_walk(room(), ranges, {});
    EXPECT_EQ(found.counts[2], 0u);
    EXPECT_GT(found.sigma_m(2), 0.28);
    EXPECT_LT(found.sigma_m(0), 0.15);
}

TEST(WalkBias, WithoutAFixThereIsNoStart) {
    EXPECT_FALSE(biases_of_walk(room(), {}, {}).solved);
    EXPECT_FALSE(biases_of_walk(room(), {{0, 1, 5, 0.1}, {0.1, 2, 6, 0.1}}, {}).solved);
}

TEST(WalkBias, GapsBeginThePathAnew) {
    SimulatedWalk walk(8);
    auto ranges = walk.ranges(60);
    std::erase_if(ranges, [](const auto& range) { return range.time_s > 20 && range.time_s < 28; });
    for (WalkRange& range : ranges)
        if (range.time_s > 30) range.time_s += 1e6;
    const Biases found = biases_of_walk(room(), ranges, {});
    ASSERT_TRUE(found.solved);
    for (Eigen::Index i = 0; i < 6; ++i)
        EXPECT_LT(std::abs(found.bias_m(i) - walk.bias_m(i)), 4 * found.sigma_m(i)) << i;
}

TEST(WalkBias, OfErrorsAgainstATruth) {
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    std::vector<KnownRange> errors;
    for (int i = 0; i < 500; ++i) errors.push_back({0, -0.3 + 0.05 * normal(random)});
    for (int i = 0; i < 50; ++i) errors.push_back({0, 2.0});
    const Biases found = biases_of_errors(2, errors, 1);
    EXPECT_NEAR(found.bias_m(0), -0.3, 4 * found.sigma_m(0));
    EXPECT_LT(found.sigma_m(0), 0.02);
    EXPECT_EQ(found.sigma_m(1), 1);
    EXPECT_FALSE(biases_of_errors(2, {}, 1).solved);
}

TEST(CorrelatedSamples, OfNoiseAndOfAWanderingError) {
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    std::vector<double> white, wandering;
    double value = 0;
    constexpr double keep = 0.8; // (1 + keep) / (1 - keep) = 9 samples count as one
    for (int i = 0; i < 20000; ++i) {
        white.push_back(normal(random));
        wandering.push_back(value = keep * value + normal(random));
    }
    EXPECT_NEAR(correlated_samples(white), 1, 0.15);
    EXPECT_NEAR(correlated_samples(wandering), 9, 1.5);
    EXPECT_EQ(correlated_samples({0, 0, 0, 0, 0, 0}), 1);
}

} // namespace
} // namespace locus::uwb::survey
