// Two models of motion: their probabilities and mixtures by themselves, and the default estimator that uses them for
// tags without an inertial sensor.
#include "fusion/estimators/inertial_ekf.h"
#include "fusion/filter/interacting.h"
#include "tests/unit/fusion/simulated_tag.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>

namespace locus {
namespace {

TEST(ModelPair, BelievesTheModelThatPredictsBetterAndForgetsWithTime) {
    filter::ModelPair models(5);
    for (int i = 0; i < 20; ++i) models.learn({0.3, 0.1}, {0.1, 0.1});
    EXPECT_DOUBLE_EQ(models.share(), 0.99);
    for (int i = 0; i < 20; ++i) models.learn({0.1, 0.3}, {0.1, 0.1});
    EXPECT_DOUBLE_EQ(models.share(), 0.01);
    models.pass(100);
    EXPECT_NEAR(models.share(), 0.5, 1e-12);
}

/// Bayes' rule by hand: two Gaussian densities, and a chain that changes with (1 - exp(-2 dt / T)) / 2.
TEST(ModelPair, FollowsBayesAndItsChain) {
    filter::ModelPair models(2);
    models.learn({0.2, 0.1}, {0.1, 0.3});
    const double first = std::exp(-0.5 * 4) / 0.1, second = std::exp(-0.5 / 9) / 0.3;
    const double share = second / (first + second);
    EXPECT_NEAR(models.share(), share, 1e-12);
    const auto mixing = models.pass(0.5);
    const double changed = (1 - std::exp(-0.5)) / 2;
    const double now = share * (1 - changed) + (1 - share) * changed;
    EXPECT_NEAR(models.share(), now, 1e-12);
    EXPECT_NEAR(mixing.second_in_first, share * changed / (1 - now), 1e-12);
    EXPECT_NEAR(mixing.first_in_second, (1 - share) * changed / now, 1e-12);
}

TEST(ModelPair, MixesMomentsAndKeepsThemSymmetric) {
    using Vector = Eigen::Vector4d;
    using Matrix = Eigen::Matrix4d;
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    const auto draw = [&] { return Matrix(Matrix::NullaryExpr([&] { return normal(random); })); };
    const Matrix root_a = draw(), root_b = draw();
    Matrix a = root_a * root_a.transpose(), b = root_b * root_b.transpose();
    a = a.selfadjointView<Eigen::Upper>().toDenseMatrix().eval();
    b = b.selfadjointView<Eigen::Upper>().toDenseMatrix().eval();
    Vector x = draw().col(0), y = draw().col(1);
    const Vector mean = 0.7 * x + 0.3 * y, other_mean = 0.2 * x + 0.8 * y;
    const auto moments = [&](const Vector& about, double share) {
        return Matrix((1 - share) * (a + (x - about) * (x - about).transpose()) +
                      share * (b + (y - about) * (y - about).transpose()));
    };
    const Matrix covariance = moments(mean, 0.3), other_covariance = moments(other_mean, 0.8);
    filter::interact(x, a, y, b, {0.3, 0.2});
    EXPECT_LT((x - mean).norm() + (y - other_mean).norm(), 1e-12);
    EXPECT_LT((a - covariance).norm() + (b - other_covariance).norm(), 1e-12);
    EXPECT_EQ(a, a.transpose());
    EXPECT_EQ(b, b.transpose());
}

/// Stands until 20 s, walks a square of sharp corners at 1.5 m/s until 60 s.
Eigen::Vector3d stands_then_walks_m(double t) {
    const Eigen::Vector3d start(-1.5, -1.5, 1.2);
    if (t < 20) return start;
    const double side_m = 3, way_m = std::fmod(1.5 * (t - 20), 4 * side_m);
    const double along_m = std::fmod(way_m, side_m);
    switch (static_cast<int>(way_m / side_m)) {
    case 0:
        return start + Eigen::Vector3d(along_m, 0, 0);
    case 1:
        return start + Eigen::Vector3d(side_m, along_m, 0);
    case 2:
        return start + Eigen::Vector3d(side_m - along_m, side_m, 0);
    default:
        return start + Eigen::Vector3d(0, side_m - along_m, 0);
    }
}

struct Rmse {
    double standing_m = 0, walking_m = 0;
};

Rmse follow(const InertialEkfSettings& settings, unsigned seed) {
    const Site site = test::hall();
    InertialEkf filter(site, settings);
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal(0, settings.range_sigma_m);
    double standing = 0, walking = 0;
    int stood = 0, walked = 0;
    for (int i = 1; i < 3000; ++i) { // each of eight anchors 6.25 times a second
        const double t = i * 0.02;
        const auto& anchor = site.anchors[static_cast<std::size_t>(i) % 8];
        const Eigen::Vector3d truth = stands_then_walks_m(t);
        const double range_m = (truth - vector(anchor.position_site_m)).norm() + normal(random);
        filter.update({timestamp_from_s(t), 0, 0, Range{anchor.address, address(9), range_m}});
        if (t < 5) continue;
        const double square = (vector(filter.predict(timestamp_from_s(t)).position_site_m) - truth).squaredNorm();
        (t < 20 ? standing : walking) += square;
        ++(t < 20 ? stood : walked);
    }
    return {std::sqrt(standing / stood), std::sqrt(walking / walked)};
}

/// What the pair is for: a tag that stands is stiller, and one that walks round corners is not further off.
TEST(NavPair, StandsStillerAndFollowsCorners) {
    InertialEkfSettings settings;
    settings.anchor_error_sigma_m = settings.anchor_offset_sigma_m = settings.common_range_error_sigma_m = 0;
    InertialEkfSettings alone = settings;
    alone.steady_acceleration_sigma_mps2 = 0;
    Rmse pair, one;
    constexpr unsigned runs = 10;
    for (unsigned seed = 1; seed <= runs; ++seed) {
        const Rmse with = follow(settings, seed), without = follow(alone, seed);
        pair = {pair.standing_m + with.standing_m / runs, pair.walking_m + with.walking_m / runs};
        one = {one.standing_m + without.standing_m / runs, one.walking_m + without.walking_m / runs};
    }
    std::printf("standing: pair %.4f m, one model %.4f m; walking: %.4f, %.4f m\n", pair.standing_m, one.standing_m,
                pair.walking_m, one.walking_m);
    EXPECT_LT(pair.standing_m, 0.85 * one.standing_m);
    EXPECT_LT(pair.walking_m, 1.02 * one.walking_m);
}

} // namespace
} // namespace locus
