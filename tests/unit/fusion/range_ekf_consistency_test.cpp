// Is the range filter as sure as it may be, and does it stay so for a million measurements?
#include "fusion/estimators/range_ekf.h"
#include "tests/support/heavy.h"
#include "tests/unit/fusion/jacobian.h"
#include "tests/unit/fusion/simulated_tag.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace locus {
namespace {

using filter::TrackState;

constexpr double step_s = 0.0125;
constexpr double run_s = 4;
constexpr int runs = 200;

/// Error of the nine states weighed by the filter's covariance: chi-square of nine degrees of freedom if it is honest.
double nees(const TrackState& track, const Eigen::Matrix3d& truth) {
    Eigen::VectorXd error(9);
    for (int axis = 0; axis < 3; ++axis)
        for (int order = 0; order < 3; ++order) {
            const int place = TrackState::place(axis, order);
            error(place) = track.state(place) - truth(order, axis);
        }
    return test::weighed_square(error, track.covariance.topLeftCorner<9, 9>());
}

enum class Hear { ranges, differences };

double nees_of_run(const RangeEkfSettings& settings, Hear hear, unsigned seed) {
    const Site site = test::hall();
    test::SimulatedTag tag(site, settings, seed);
    RangeEkf filter(site, settings);
    for (std::size_t i = 0; tag.time_s() < 1 + run_s; ++i) {
        const std::size_t anchor = i % 8;
        filter.update(hear == Hear::ranges ? tag.range(anchor) : tag.difference(anchor, (anchor + 3) % 8));
        if (tag.time_s() < 1 + run_s - step_s)
            tag.move(step_s);
        else
            break;
    }
    EXPECT_EQ(filter.predict(timestamp_from_s(tag.time_s())).missing, Missing::nothing) << "seed " << seed;
    return nees(filter.track(), tag.motion());
}

double mean_nees(const RangeEkfSettings& settings, Hear hear) {
    double sum = 0;
    for (unsigned seed = 1; seed <= runs; ++seed) sum += nees_of_run(settings, hear, seed);
    return sum / runs;
}

struct Band {
    double low, high;
};
/// Where the mean of `runs` honest NEES of nine states lies 95 times of 100.
Band band() {
    return {test::chi_square_quantile(9 * runs, 0.025) / runs, test::chi_square_quantile(9 * runs, 0.975) / runs};
}

/// The noise of the simulation is Gaussian: then no weight and no gate is the optimum, and the covariance is exact.
RangeEkfSettings gaussian() {
    RangeEkfSettings settings;
    settings.robust_scale = 1e6;
    settings.gate_false_alarm = 1e-12;
    return settings;
}

TEST(RangeEkfConsistency, MeanNeesIsInItsBandOnRanges) {
    const double mean = mean_nees(gaussian(), Hear::ranges);
    EXPECT_GT(mean, band().low);
    EXPECT_LT(mean, band().high);
}

TEST(RangeEkfConsistency, MeanNeesIsInItsBandOnDifferences) {
    const double mean = mean_nees(gaussian(), Hear::differences);
    EXPECT_GT(mean, band().low);
    EXPECT_LT(mean, band().high);
}

// Robust weights are not the optimum for Gaussian noise; the covariance must say how much they cost.
TEST(RangeEkfConsistency, MeanNeesIsInItsBandWithTheDefaultsToo) {
    for (const Hear hear : {Hear::ranges, Hear::differences}) {
        const double mean = mean_nees({}, hear);
        std::printf("mean NEES on %s %.2f, band %.2f to %.2f\n", hear == Hear::ranges ? "ranges" : "differences", mean,
                    band().low, band().high);
        EXPECT_GT(mean, band().low);
        EXPECT_LT(mean, band().high);
    }
}

// A filter that believes half the noise must fail the very test above, or that test proves nothing.
TEST(RangeEkfConsistency, ATooSureFilterIsFoundOut) {
    const Site site = test::hall();
    double sum = 0;
    for (unsigned seed = 1; seed <= runs; ++seed) {
        test::SimulatedTag tag(site, gaussian(), seed);
        RangeEkfSettings sure = gaussian();
        sure.anchor_error_sigma_m /= 2;
        RangeEkf filter(site, sure);
        for (std::size_t i = 0; tag.time_s() < 1 + run_s; ++i) {
            tag.move(step_s);
            filter.update(tag.difference(i % 8, (i + 3) % 8));
        }
        sum += nees(filter.track(), tag.motion());
    }
    EXPECT_GT(sum / runs, band().high);
}

TEST(RangeEkfConsistency, MillionMeasurementsLeaveTheCovarianceSymmetricAndPositive) {
    const Site site = test::hall();
    RangeEkf filter(site, {});
    std::mt19937 random(5);
    std::normal_distribution<double> noise_m(0, 0.1);
    for (int i = 0; i < 1'000'000; ++i) {
        const double t = 1 + 0.002 * i;
        const Eigen::Vector3d p(3 * std::cos(t), 3 * std::sin(t), 1.5 + std::sin(0.3 * t));
        const auto a = static_cast<std::int16_t>(i % 8), b = static_cast<std::int16_t>((i + 3) % 8);
        const uwb::Sighting sighting{b, i % 2 == 0 ? a : uwb::Sighting::nobody, 0.1f, 0};
        const double value_m = uwb::predicted_m(sighting, site, p) + noise_m(random);
        const auto from = address(static_cast<std::uint64_t>(a)), to = address(static_cast<std::uint64_t>(b));
        Observation heard = Range{to, address(9), value_m};
        if (!sighting.is_range()) heard = RangeDifference{from, to, address(9), value_m};
        filter.update({timestamp_from_s(t), 0, 0, heard});
    }
    const TrackState::Matrix& covariance = filter.track().covariance;
    ASSERT_GT(covariance.rows(), 9);
    EXPECT_EQ(covariance, TrackState::Matrix(covariance.transpose()));
    EXPECT_GT(test::eigenvalues(covariance).minCoeff(), 0);
    const double t = 1 + 0.002 * 999'999;
    const Eigen::Vector3d p(3 * std::cos(t), 3 * std::sin(t), 1.5 + std::sin(0.3 * t));
    EXPECT_LT((filter.track().position_m() - p).norm(), 0.3);
    EXPECT_EQ(filter.predict(timestamp_from_s(t)).reset_count, 0u);
}

TEST(Sighting, GradientsMatchDifferencesOnBothKinds) {
    const Site site = test::hall();
    for (const uwb::Sighting sighting :
         {uwb::Sighting{2, uwb::Sighting::nobody, 0.1f, 0}, uwb::Sighting{2, 5, 0.1f, 0}})
        for (const Eigen::Vector3d& p :
             {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(-4, 4, 0.3), Eigen::Vector3d(30, 9, -2)})
            EXPECT_TRUE(test::jacobian_matches(
                [&](const Eigen::VectorXd& x) { return uwb::predicted_m(sighting, site, x.head<3>()); },
                uwb::gradient(sighting, site, p).transpose(), p));
}

TEST(TrackState, AnAnchorNotHeardForLongestGivesItsPlaceAway) {
    TrackState track(filter::TrackModel{});
    track.start({1, 2, 3}, Eigen::Matrix3d::Identity());
    for (int key = 0; key < TrackState::max_wanderers; ++key) EXPECT_EQ(track.wanderer(key, {0.2, 1}), 9 + key);
    EXPECT_EQ(track.wanderer(0, {0.2, 1}), 9);
    track.state(10) = 7;
    track.covariance(10, 0) = track.covariance(0, 10) = 0.1;
    EXPECT_EQ(track.wanderer(99, {0.3, 1}), 10) << "number 1 was asked for longest ago";
    EXPECT_EQ(track.size(), TrackState::max_size);
    EXPECT_EQ(track.state(10), 0);
    EXPECT_EQ(track.covariance(10, 0), 0);
    EXPECT_DOUBLE_EQ(track.covariance(10, 10), 0.3 * 0.3);
}

TEST(TrackState, PredictionInBlocksIsThePredictionOfTheWholeMatrix) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    TrackState track(filter::TrackModel{{1.5, 0.7}, 1, false});
    track.start({1, 2, 3}, Eigen::Matrix3d::Identity());
    const filter::WanderModel models[]{{0.2, 0.3}, {0.5, no_limit}};
    for (int key = 0; key < 2; ++key) track.wanderer(key, models[key]);
    const Eigen::MatrixXd root = Eigen::MatrixXd::NullaryExpr(11, 11, [&] { return normal(random); });
    track.covariance = test::carried(root, Eigen::MatrixXd::Identity(11, 11));
    track.state = Eigen::VectorXd::NullaryExpr(11, [&] { return normal(random); });

    const double dt = 0.4;
    const auto step = filter::axis_step({1.5, 0.7}, dt);
    Eigen::MatrixXd transition = Eigen::MatrixXd::Zero(11, 11), noise = transition;
    for (int axis = 0; axis < 3; ++axis) {
        transition.block<3, 3>(3 * axis, 3 * axis) = step.transition;
        noise.block<3, 3>(3 * axis, 3 * axis) = step.noise;
    }
    for (int key = 0; key < 2; ++key) {
        const auto wander = filter::wander_step(models[key].sigma, models[key].time_s, dt);
        transition(9 + key, 9 + key) = wander.keep;
        noise(9 + key, 9 + key) = wander.variance;
    }
    const Eigen::VectorXd state = transition * track.state;
    const Eigen::MatrixXd covariance = test::carried(transition, track.covariance) + noise;
    track.predict(dt);
    EXPECT_LT((track.state - state).norm(), 1e-12);
    EXPECT_LT((track.covariance - covariance).norm(), 1e-12 * covariance.norm());
}

} // namespace
} // namespace locus
