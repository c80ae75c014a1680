// Feet that a camera sees, in radio_particles: the walker of radio_particles_test.cpp, and a camera besides.
#include "tests/unit/fusion/radio/radio_hall.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <random>

namespace locus {
namespace {

using test::RadioHall;

/// Ten pictures a second. Their error is as the settings expect it: a part that is new each time, one that stays for a
/// second.
class Feet {
  public:
    static constexpr double white_m = 0.15, held_m = 0.2;

    Verdict see(RadioHall& hall, const Eigen::Vector2d& beside_m = {0, 0}) {
        const double keep = std::exp(-0.1);
        for (double& each : held_) each = keep * each + std::sqrt(1 - keep * keep) * held_m * normal_(random_);
        const auto variance_m2 = static_cast<float>(white_m * white_m);
        const Eigen::Vector2d at = hall.walker.position_m().head<2>() + beside_m;
        FootPoint foot;
        foot.position_site_m = {at.x() + held_[0] + white_m * normal_(random_),
                                at.y() + held_[1] + white_m * normal_(random_)};
        foot.covariance_m2 = {variance_m2, 0, variance_m2};
        return hall.filter.update({hall.walker.time(), 0, 0, foot});
    }

  private:
    std::mt19937 random_{3};
    std::normal_distribution<double> normal_;
    double held_[2]{};
};

struct FeetScore {
    double mean_m = 0, within_bound = 0;
};

FeetScore walk_seen(RadioHall& hall, Feet& feet, int pictures, const Eigen::Vector2d& beside_m = {0, 0}) {
    FeetScore score;
    for (int i = 0; i < pictures; ++i) {
        hall.walk(0.1);
        feet.see(hall, beside_m);
        const double error_m = hall.error_m();
        const Estimate estimate = hall.estimate();
        score.mean_m += error_m / pictures;
        score.within_bound +=
            (error_m < 2.45 * std::sqrt(0.5 * (estimate.covariance[0] + estimate.covariance[7]))) / double(pictures);
    }
    return score;
}

/// Without an inertial unit, so that between feet nothing but a wandering velocity leads him.
TEST(RadioFeet, WhoIsSeenIsKnownFarBetter) {
    FeetScore sum;
    double unseen_m = 0;
    constexpr int seeds = 5;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        RadioHall hall(true, seed, false), unseen(true, seed, false);
        Feet feet;
        hall.walk(10);
        unseen.walk(50);
        unseen_m += unseen.mean_m() / seeds;
        const FeetScore score = walk_seen(hall, feet, 400);
        sum.mean_m += score.mean_m / seeds;
        sum.within_bound += score.within_bound / seeds;
    }
    std::printf("seen: mean %.2f m, within its 95 %% bound %.0f %%; unseen %.2f m\n", sum.mean_m,
                100 * sum.within_bound, unseen_m);
    EXPECT_LT(sum.mean_m, 0.5 * unseen_m);
    EXPECT_GT(sum.within_bound, 0.93);
    EXPECT_LT(sum.within_bound, 0.99) << "too modest";
}

TEST(RadioFeet, BeginWithoutARadio) {
    RadioHall hall;
    Feet feet;
    EXPECT_EQ(feet.see(hall).reason, Exclusion::none);
    EXPECT_EQ(hall.estimate().missing, Missing::nothing);
    EXPECT_LT(hall.error_m(), 1);
}

TEST(RadioFeet, OfSomebodyElseAreRefusedAtFirst) {
    RadioHall hall;
    Feet feet;
    hall.walk(10);
    walk_seen(hall, feet, 50);
    EXPECT_EQ(feet.see(hall, {0, 5}).reason, Exclusion::innovation_too_large);
    EXPECT_LT(hall.error_m(), 0.7);
}

/// What an identity that was taken back leaves behind is gone as soon as the right feet are seen again.
TEST(RadioFeet, TheRightOnesAreBelievedAgainAfterWrongOnes) {
    RadioHall hall;
    Feet feet;
    hall.walk(10);
    walk_seen(hall, feet, 30, {0, 5});
    walk_seen(hall, feet, 20);
    EXPECT_LT(walk_seen(hall, feet, 20).mean_m, 0.5);
}

TEST(RadioFeet, ThatAreNoPlaceAreRefused) {
    RadioHall hall;
    FootPoint foot;
    foot.covariance_m2 = {1, 2, 1};
    EXPECT_EQ(hall.filter.update({hall.walker.time(), 0, 0, foot}).reason, Exclusion::not_finite);
    EXPECT_NE(hall.estimate().missing, Missing::nothing);
}

} // namespace
} // namespace locus
