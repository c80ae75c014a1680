#include "fusion/estimators/walker_particles.h"
#include "tests/allocations.h"
#include "tests/unit/fusion/inertial/simulated_walker.h"
#include "tests/unit/fusion/walker_bound.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace locus::walkers {
namespace {

using test::Anchors2;
using test::SimulatedWalker;
using test::WalkerModel;
using test::WanderingWalk;

constexpr double tag_height_m = 1.2;

Site site_of(const Anchors2& anchors) {
    Site site;
    for (const Eigen::Vector2d& a : anchors)
        site.anchors.push_back({"", address(site.anchors.size()), {a.x(), a.y(), tag_height_m}});
    return site;
}

Anchors2 corners(double width_m, double depth_m) { return {{0, 0}, {width_m, 0}, {width_m, depth_m}, {0, depth_m}}; }

Anchors2 eight(double width_m, double depth_m) {
    Anchors2 all = corners(width_m, depth_m);
    for (const Eigen::Vector2d& more : {Eigen::Vector2d(width_m / 2, 0), Eigen::Vector2d(width_m / 2, depth_m),
                                        Eigen::Vector2d(0, depth_m / 2), Eigen::Vector2d(width_m, depth_m / 2)})
        all.push_back(more);
    return all;
}

/// Ranges with white noise: no error that anchors carry along, no doubt about the height.
WalkerParticlesSettings white_noise() {
    WalkerParticlesSettings settings;
    settings.anchor_error_sigma_m = 0;
    settings.height_sigma_m = 0;
    return settings;
}

Measurement range_at(double time_s, std::size_t anchor, double range_m) {
    return {timestamp_from_s(time_s), 0, 0, Range{address(anchor), address(9), range_m}};
}

Eigen::Vector2d place(const Estimate& estimate) { return {estimate.position_site_m[0], estimate.position_site_m[1]}; }

double squared_in_sigma(const Estimate& estimate, const Eigen::Vector2d& truth) {
    Eigen::Matrix2d covariance;
    covariance << estimate.covariance[0], estimate.covariance[1], estimate.covariance[6], estimate.covariance[7];
    const Eigen::Vector2d error = place(estimate) - truth;
    return error.dot(covariance.inverse() * error);
}

struct AgainstBound {
    double ratio = 0; ///< RMSE over the bound's root
    double nees = 0;  ///< mean, of two degrees of freedom
};

AgainstBound against_bound(const Anchors2& anchors, int particles, int least, int runs) {
    const WanderingWalk walk;
    const Site site = site_of(anchors);
    WalkerParticlesSettings settings = white_noise();
    settings.velocity_wander_mps_rts = walk.wander_mps_rts;
    settings.speed_sigma_mps = walk.speed_sigma_mps;
    settings.max_particles = particles;
    settings.min_particles = least;
    std::mt19937 random(20261122);
    std::normal_distribution<double> normal;
    std::vector<std::vector<Eigen::Vector4d>> walks;
    double squares = 0, nees = 0;
    int scored = 0;
    for (int run = 0; run < runs; ++run) {
        settings.seed = run + 1;
        WalkerParticles filter(site, settings);
        const auto& states = walks.emplace_back(walk.draw({15, 12}, random));
        for (std::size_t epoch = 0; epoch < states.size(); ++epoch) {
            const double time_s = 1 + walk.dt_s * static_cast<double>(epoch);
            const Eigen::Vector2d truth = states[epoch].head<2>();
            for (std::size_t i = 0; i < anchors.size(); ++i)
                filter.update(range_at(time_s, i, (truth - anchors[i]).norm() + walk.range_sigma_m * normal(random)));
            if (2 * epoch < states.size()) continue;
            const Estimate estimate = filter.predict(timestamp_from_s(time_s));
            squares += (place(estimate) - truth).squaredNorm();
            nees += squared_in_sigma(estimate, truth);
            ++scored;
        }
    }
    return {std::sqrt(squares / scored / bound_m2(walk, anchors, walks)), nees / scored};
}

/// The bar of issue 4: with 1,000 particles within 1.15 of the posterior Cramer-Rao bound. 150 walks of 5 s, scored at
/// 10 Hz; the bound itself is known to about 2 %. The NEES of 2 degrees of freedom: the errors of a walk are
/// correlated over about half a second, so 1,500 independent ones, 2 +- 0.1; the tails under the likelihood widen.
TEST(WalkerParticles, IsWithinOneTenthAndAHalfOfTheBoundWithEightAnchors) {
    const AgainstBound result = against_bound(eight(30, 24), 1000, 1000, 150);
    std::printf("8 anchors, 1000 particles: %.3f of the bound, NEES %.2f\n", result.ratio, result.nees);
    EXPECT_LE(result.ratio, 1.15);
    EXPECT_LT(result.nees, 2.3);
    EXPECT_GT(result.nees, 1.5);
}

TEST(WalkerParticles, IsWithinOneTenthAndAHalfOfTheBoundWithFourAnchors) {
    const AgainstBound result = against_bound(corners(30, 24), 1000, 1000, 150);
    std::printf("4 anchors, 1000 particles: %.3f of the bound, NEES %.2f\n", result.ratio, result.nees);
    EXPECT_LE(result.ratio, 1.15);
    EXPECT_LT(result.nees, 2.3);
    EXPECT_GT(result.nees, 1.5);
}

TEST(WalkerParticles, FewerParticlesWhereThePositionIsSureCostLittle) {
    const AgainstBound result = against_bound(corners(30, 24), 1000, 250, 60);
    std::printf("4 anchors, 250 to 1000 particles: %.3f of the bound, NEES %.2f\n", result.ratio, result.nees);
    EXPECT_LE(result.ratio, 1.25);
}

/// A person with a worn unit in a hall; ranges of 10 cm at 5 Hz, the first with an excess.
struct Hall {
    explicit Hall(const WalkerParticlesSettings& settings, unsigned seed = 5, bool worn_unit = true)
        : site(site_of(corners(30, 24))), filter(site, settings), walker(WalkerModel{}, seed), random(seed),
          unit(worn_unit) {
        walker.place({5, 5}, 0.3);
    }

    void walk(double seconds, bool ranges, double turn_radps = 0, double excess_m = 0) {
        for (const double end_s = walker.time_s() + seconds; walker.time_s() < end_s;) {
            const ImuSample sample = walker.move(turn_radps);
            if (unit) filter.update({walker.time(), 0, 0, sample});
            if (!ranges || ++samples % 20 != 0) continue;
            for (std::size_t i = 0; i < site.anchors.size(); ++i) hear_range(i, i == 0 ? excess_m : 0);
        }
    }
    void stand(double seconds) {
        for (const double end_s = walker.time_s() + seconds; walker.time_s() < end_s;) {
            const ImuSample sample = walker.move(0, false);
            filter.update({walker.time(), 0, 0, sample});
        }
    }
    void hear_range(std::size_t i, double excess_m) {
        const Eigen::Vector2d anchor(site.anchors[i].position_site_m[0], site.anchors[i].position_site_m[1]);
        const double range_m = (walker.position_m() - anchor).norm() + excess_m + 0.1 * normal(random);
        filter.update(range_at(walker.time_s(), i, range_m));
    }
    Estimate estimate() const { return filter.predict(walker.time()); }
    double error_m() const { return (place(estimate()) - walker.position_m()).norm(); }

    Site site;
    WalkerParticles filter;
    SimulatedWalker walker;
    std::mt19937 random;
    std::normal_distribution<double> normal;
    bool unit;
    int samples = 0;
};

/// Twenty seconds without a range are 26 m of steps. The heading that a minute of ranges taught drifts by
/// course_wander_rad_rts, 0.13 rad in that time, which is 2 m at the end of the way; without steps it is 26 m. The unit
/// was switched on by someone who stood, which showed the gyroscope's bias.
TEST(WalkerParticles, StepsCarryAPersonThroughASilence) {
    double squares = 0;
    int within = 0;
    constexpr int people = 20;
    for (unsigned seed = 1; seed <= people; ++seed) {
        Hall hall(white_noise(), seed);
        hall.stand(5);
        for (int lap = 0; lap < 4; ++lap) {
            hall.walk(5, true);
            hall.walk(1, true, 1.57);
        }
        hall.walk(2, true);
        hall.walk(20, false);
        squares += hall.error_m() * hall.error_m();
        within += squared_in_sigma(hall.estimate(), hall.walker.position_m()) < 5.99; // 95 % of two degrees of freedom
    }
    std::printf("20 s of steps: %.2f m RMSE, %d of %d within the 95 %% ellipse\n", std::sqrt(squares / people), within,
                people);
    EXPECT_LT(std::sqrt(squares / people), 2.5);
    EXPECT_GE(within, 16); // 19 are expected; fewer than 16 happens once in 300 times
}

TEST(WalkerParticles, LearnsHowLongAPersonsStepsAre) {
    Hall hall(white_noise());
    for (int lap = 0; lap < 6; ++lap) {
        hall.walk(8, true);
        hall.walk(1, true, 1.57);
    }
    const auto& cloud = hall.filter.cloud();
    EXPECT_LT(std::sqrt(cloud.covariance()(2, 2) + cloud.covariance()(3, 3)), 0.15);
    EXPECT_LT(hall.error_m(), 0.3);
}

TEST(WalkerParticles, GoesOnWithoutTheUnitWhenItFallsSilent) {
    Hall hall(white_noise());
    hall.walk(20, true);
    hall.unit = false;
    hall.walk(20, true, 0.1);
    EXPECT_LT(hall.error_m(), 0.5);
    EXPECT_EQ(hall.estimate().kinds_used, 1u);
}

/// One of four paths longer by a metre all the time: a least-squares fix moves by some 0.5 m.
TEST(WalkerParticles, ABlockedPathHardlyMovesIt) {
    double clean = 0, blocked = 0;
    for (unsigned seed = 1; seed <= 10; ++seed)
        for (const double excess_m : {0.0, 1.0}) {
            Hall hall(white_noise(), seed);
            hall.walk(10, true, 0.1);
            for (int i = 0; i < 20; ++i) {
                hall.walk(0.5, true, 0.1, excess_m);
                (excess_m > 0 ? blocked : clean) += hall.error_m() / 200;
            }
        }
    std::printf("mean error %.3f m, with one path blocked %.3f m\n", clean, blocked);
    EXPECT_LT(blocked, 1.5 * clean);
}

TEST(WalkerParticles, FindsAPersonWhoIsPlainlyElsewhere) {
    Hall hall(white_noise());
    hall.walk(10, true);
    hall.walker.place({20, 18}, 0);
    hall.walk(6, true);
    EXPECT_LT(hall.error_m(), 0.5);
    EXPECT_EQ(hall.estimate().reset_count, 1u);
}

/// A corridor and one anchor at its end, whose ranges hardly tell one side of a wall from the other: the wall does.
TEST(WalkerParticles, NobodyWalksThroughAWall) {
    for (const bool wall : {false, true}) {
        Hall hall(white_noise(), 3, false);
        if (wall) hall.site.walls.push_back({{0, 2, 0}, {30, 2, 0}});
        hall.walker.place({3, 0.5}, 0);
        hall.walk(2, true);
        for (int i = 0; i < 100; ++i) { // 13 m along the wall, with but the anchor at the far end
            hall.walk(0.1, false);
            hall.hear_range(1, 0);
        }
        const double above_m =
            hall.filter.cloud().mean()(1) + 12 + 2 * std::sqrt(hall.filter.cloud().covariance()(1, 1));
        EXPECT_EQ(above_m > 2.5, !wall) << above_m;
    }
}

TEST(WalkerParticles, ACopyGoesOnAsTheFirstToTheBitAndNothingIsAllocated) {
    Hall first(white_noise()), second(white_noise());
    first.walk(12, true, 0.1);
    const test::AllocationCount allocations;
    second.filter.copy_from(first.filter);
    second.walker = first.walker;
    second.random = first.random;
    second.normal = first.normal;
    second.samples = first.samples;
    first.walk(5, true, 0.2);
    second.walk(5, true, 0.2);
    const Estimate a = first.estimate(), b = second.estimate();
    EXPECT_EQ(allocations.made(), 0u);
    EXPECT_EQ(a.position_site_m, b.position_site_m);
    EXPECT_EQ(a.covariance, b.covariance);
}

TEST(WalkerParticles, PosesGoSmoothlyFromStepToStep) {
    Hall hall(white_noise());
    hall.walk(30, true);
    Eigen::Vector2d last = place(hall.estimate());
    for (int i = 0; i < 200; ++i) {
        hall.walk(0.01, false);
        const Eigen::Vector2d now = place(hall.estimate());
        EXPECT_LT((now - last).norm(), 0.15) << "at " << i; // a step is 0.72 m
        last = now;
    }
}

} // namespace
} // namespace locus::walkers
