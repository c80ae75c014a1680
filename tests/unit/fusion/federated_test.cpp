// The federated estimator by what it promises: it starts from either sensor, falls to one when the other is blind and
// back without a jump that its covariance does not allow, and says why it refuses.
#include "fusion/estimators/federated.h"
#include "tests/allocations.h"
#include "tests/support/heavy.h"
#include "tests/unit/fusion/simulated_tag.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <random>

namespace locus::federated_test {
namespace {

constexpr double foot_sigma_m = 0.15, fresh_range_m = 0.1;
constexpr double tag_m = 1.0;

struct Blind {
    double from_s = 1e9, to_s = 1e9;
    bool at(double t) const { return t >= from_s && t < to_s; }
};

/// Somebody who walks round a circle of 2 m at 1 m/s in the hall.
class Person {
  public:
    Person(const Site& site, unsigned seed) : site_(site), random_(seed) {}

    static Eigen::Vector2d place_m(double t) { return {2 * std::cos(t / 2), 2 * std::sin(t / 2)}; }

    /// As a tracker tells: most of its error is that of the image before.
    FootPoint foot(double t, double off_m = 0) {
        const auto wander = filter::wander_step(foot_sigma_m, 1, t - seen_s_);
        for (double& off : off_m_) off = wander.keep * off + std::sqrt(wander.variance) * draw();
        seen_s_ = t;
        const Eigen::Vector2d seen = place_m(t) + Eigen::Vector2d(off_m_[0], off_m_[1]);
        return {address(50), 3, {seen.x() + off_m, seen.y()}, {0.0225F, 0, 0.0225F}};
    }
    Range range(std::size_t anchor, double t) {
        const Eigen::Vector3d tag(place_m(t).x(), place_m(t).y(), tag_m);
        const double distance_m = (vector(site_.anchors[anchor].position_site_m) - tag).norm();
        return {site_.anchors[anchor].address, address(9), distance_m + fresh_range_m * draw()};
    }

    /// What comes after `from_s` until `to_s` goes into the estimator.
    void walk(Estimator& estimator, double from_s, double to_s, const Blind& uwb = {}, const Blind& camera = {}) {
        for (int i = static_cast<int>(std::lround(from_s / 0.025)) + 1; i <= std::lround(to_s / 0.025); ++i) {
            const double t = 0.025 * i;
            if (i % 4 == 0 && !uwb.at(t))
                for (std::size_t anchor = 0; anchor < site_.anchors.size(); ++anchor)
                    estimator.update({timestamp_from_s(t), 0, 0, range(anchor, t)});
            if (i % 5 == 0 && !camera.at(t)) estimator.update({timestamp_from_s(t), 0, 0, foot(t)});
        }
    }

  private:
    double draw() { return normal_(random_); }

    const Site& site_;
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
    std::array<double, 2> off_m_{};
    double seen_s_ = -1e3;
};

Eigen::Vector2d place(const Estimate& e) { return {e.position_site_m[0], e.position_site_m[1]}; }
Eigen::Matrix2d doubt(const Estimate& e) {
    return (Eigen::Matrix2d() << e.covariance[0], e.covariance[1], e.covariance[6], e.covariance[7]).finished();
}
double error_m(const Estimate& e, double t) { return (place(e) - Person::place_m(t)).norm(); }

constexpr std::uint32_t bit(std::size_t kind) { return 1u << kind; }

TEST(Federated, StartsFromFootPointsAlone) {
    const Site site; // nobody to range
    Person person(site, 1);
    Federated estimator(site, {});
    EXPECT_EQ(estimator.predict(timestamp_from_s(0)).missing, Missing::measurements);
    person.walk(estimator, 0, 0.125);
    const Estimate first = estimator.predict(timestamp_from_s(0.125));
    EXPECT_EQ(first.missing, Missing::nothing);
    EXPECT_LT(error_m(first, 0.125), 3 * foot_sigma_m);
    person.walk(estimator, 0.125, 10);
    const Estimate later = estimator.predict(timestamp_from_s(10));
    EXPECT_LT(error_m(later, 10), 3 * foot_sigma_m);
    EXPECT_EQ(later.position_site_m[2], FederatedSettings{}.height_m);
    EXPECT_NEAR(std::sqrt(later.covariance[14]), 0.3, 1e-9) << "of the height";
    EXPECT_EQ(later.kinds_used, bit(6));
    EXPECT_NEAR(std::hypot(later.velocity_site_mps[0], later.velocity_site_mps[1]), 1, 0.5);
}

TEST(Federated, StartsFromRangesAlone) {
    const Site site = test::hall();
    Person person(site, 2);
    Federated estimator(site, {});
    person.walk(estimator, 0, 10, {}, {0, 20});
    const Estimate estimate = estimator.predict(timestamp_from_s(10));
    EXPECT_EQ(estimate.missing, Missing::nothing);
    EXPECT_LT(error_m(estimate, 10), 0.3);
    EXPECT_EQ(estimate.kinds_used, bit(0));
}

TEST(Federated, BothAreSurerThanEither) {
    const Site site = test::hall();
    double one = 0, other = 0, both = 0;
    for (unsigned seed = 1; seed <= 20; ++seed) {
        const auto square = [&](const Blind& uwb, const Blind& camera) {
            Person person(site, seed);
            Federated estimator(site, {});
            double sum = 0;
            for (int t = 0; t < 10; ++t) {
                person.walk(estimator, t, t + 1, uwb, camera);
                sum += t < 3 ? 0 : std::pow(error_m(estimator.predict(timestamp_from_s(t + 1)), t + 1), 2);
            }
            return sum;
        };
        one += square({}, {0, 20});
        other += square({0, 20}, {});
        both += square({}, {});
    }
    EXPECT_LT(both, std::min(one, other));
}

// When a sensor that was blind comes back, the published place may move by what was not known before and is now: the
// covariance just before, and what it is after. Squares of such steps are chi-squares of two at most.
void hand_over(const Blind& uwb, const Blind& camera, double back_s) {
    const Site site = test::hall();
    double mean = 0, largest = 0, longest_m = 0;
    constexpr unsigned persons = 100;
    for (unsigned seed = 1; seed <= persons; ++seed) {
        Person person(site, seed);
        Federated estimator(site, {});
        person.walk(estimator, 0, 5, uwb, camera);
        double worst = 0;
        for (int i = 200; 0.025 * i < back_s + 1.5; ++i) {
            const double t = 0.025 * i;
            const Timestamp now = timestamp_from_s(t + 0.025);
            const Estimate before = estimator.predict(now);
            person.walk(estimator, t, t + 0.025, uwb, camera);
            const Estimate after = estimator.predict(now);
            ASSERT_EQ(after.missing, Missing::nothing) << t;
            const Eigen::Vector2d step_m = place(after) - place(before);
            const double squared = test::weighed_square(step_m, doubt(before));
            worst = std::max(worst, squared);
            longest_m = std::max(longest_m, step_m.norm());
            EXPECT_EQ(after.reset_count, 0u);
        }
        mean += worst / persons;
        largest = std::max(largest, worst);
    }
    std::printf("largest step of a walk: %.3f m; squared, in its covariance: mean of the largest %.2f, largest %.2f\n",
                longest_m, mean, largest);
    EXPECT_LT(largest, test::chi_square_quantile(2, 0.99));
}

TEST(Federated, FallsToUwbAndBackWithoutAJump) { hand_over({}, {5, 8}, 8); }
TEST(Federated, FallsToTheCameraAndBackWithoutAJump) { hand_over({5, 8}, {}, 8); }
TEST(Federated, ComesBackWithoutAJumpAlsoWhenItsFilterWasSoonEnough) { hand_over({}, {5, 6.5}, 6.5); }

TEST(Federated, LongAfterABlindnessTheOtherSensorIsAllThereIs) {
    const Site site = test::hall();
    Person person(site, 5);
    Federated estimator(site, {}), alone(site, {});
    person.walk(estimator, 0, 5);
    const Person again(site, 6);
    for (Federated* e : {&estimator, &alone}) {
        Person same = again;
        same.walk(*e, 5, 15, {}, {5, 20});
    }
    const Estimate a = estimator.predict(timestamp_from_s(15)), b = alone.predict(timestamp_from_s(15));
    EXPECT_LT((place(a) - place(b)).norm(), 0.01);
    EXPECT_NEAR(a.covariance[0] / b.covariance[0], 1, 0.03);
}

TEST(Federated, RefusesWithTheReason) {
    const Site site = test::hall();
    Person person(site, 3);
    Federated estimator(site, {});
    person.walk(estimator, 0, 3);
    const auto answer = [&](const Observation& o) { return estimator.update({timestamp_from_s(3), 0, 0, o}); };
    FootPoint foot = person.foot(3);
    const Verdict good = answer(foot);
    EXPECT_EQ(good.reason, Exclusion::none);
    EXPECT_LT(good.test_ratio, 1);
    EXPECT_GT(good.innovation_sigma, foot_sigma_m / 2);
    foot.position_site_m[0] += 5;
    const Verdict far = answer(foot);
    EXPECT_EQ(far.reason, Exclusion::innovation_too_large);
    EXPECT_NEAR(far.innovation, 5, 1);
    EXPECT_GT(far.test_ratio, 1);
    EXPECT_EQ(far.weight, 0);
    foot.position_site_m[0] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(answer(foot).reason, Exclusion::not_finite);
    foot = person.foot(3);
    foot.covariance_m2 = {0.04F, 0.05F, 0.04F}; // no covariance
    EXPECT_EQ(answer(foot).reason, Exclusion::not_finite);
    EXPECT_EQ(answer(Range{address(77), address(9), 3}).reason, Exclusion::unknown_source);
    EXPECT_EQ(answer(Pressure{address(9), 101325}).reason, Exclusion::unsupported_kind);
    EXPECT_LT(error_m(estimator.predict(timestamp_from_s(3)), 3), 0.5);
}

TEST(Federated, GoesWhereFootPointsStayWhenTheyAreAllThereIs) {
    const Site site;
    Person person(site, 4);
    Federated estimator(site, {});
    person.walk(estimator, 0, 3);
    int refused = 0;
    for (int i = 25; i < 48; ++i) {
        const double t = 0.125 * i;
        refused += estimator.update({timestamp_from_s(t), 0, 0, person.foot(t, 6)}).reason != Exclusion::none;
    }
    EXPECT_GE(refused, 3);
    EXPECT_LE(refused, 4) << "half a second";
    const Estimate estimate = estimator.predict(timestamp_from_s(6));
    EXPECT_NEAR(estimate.position_site_m[0], Person::place_m(6).x() + 6, 0.5);
    EXPECT_EQ(estimate.reset_count, 1u) << "clients are told of the jump";
}

/// Of the place's deviation along x after five seconds in which the camera is off by `off_m`.
double sigma_when_off(double off_m) {
    const Site site = test::hall();
    Person person(site, 7);
    Federated estimator(site, {});
    for (int sweep = 1; sweep < 50; ++sweep) {
        const double t = 0.1 * sweep;
        estimator.update({timestamp_from_s(t), 0, 0, person.foot(t, off_m)});
        for (std::size_t i = 0; i < 8; ++i) estimator.update({timestamp_from_s(t), 0, 0, person.range(i, t)});
    }
    const Estimate estimate = estimator.predict(timestamp_from_s(5));
    const double squared = test::weighed_square(Person::place_m(5) - place(estimate), doubt(estimate));
    EXPECT_LT(squared, test::chi_square_quantile(2, 0.99)) << off_m;
    return std::sqrt(estimate.covariance[0]);
}

TEST(Federated, ContradictionWidensTheBound) {
    const double agreed_m = sigma_when_off(0);
    EXPECT_LT(sigma_when_off(0.3), 1.2 * agreed_m);
    EXPECT_GT(sigma_when_off(2), 1.5 * agreed_m);
    EXPECT_GT(sigma_when_off(4), 3 * agreed_m);
}

TEST(Federated, PredictChangesNothingAndACopyGivesTheSameBits) {
    const Site site = test::hall();
    Person person(site, 8);
    Federated estimator(site, {}), other(site, {});
    person.walk(estimator, 0, 3);
    const auto clone = estimator.clone();
    other.copy_from(estimator);
    estimator.predict(timestamp_from_s(9));
    for (Estimator* e : {static_cast<Estimator*>(&estimator), clone.get(), static_cast<Estimator*>(&other)}) {
        Person same = person;
        same.walk(*e, 3, 5);
    }
    const Estimate a = estimator.predict(timestamp_from_s(5));
    for (const Estimator* e : {clone.get(), static_cast<Estimator*>(&other)}) {
        const Estimate b = e->predict(timestamp_from_s(5));
        EXPECT_EQ(a.position_site_m, b.position_site_m);
        EXPECT_EQ(a.covariance, b.covariance);
    }
}

TEST(Federated, AllocatesNothing) {
    const Site site = test::hall();
    Person person(site, 9);
    Federated estimator(site, {}), other(site, {});
    const test::AllocationCount count;
    for (int i = 0; i < 20; ++i) { // with both sensors blind for longer than their memory
        person.walk(estimator, i, i + 1, {5, 9}, {12, 16});
        other.copy_from(estimator);
        EXPECT_EQ(other.predict(timestamp_from_s(1.0 + i)).missing, Missing::nothing);
    }
    EXPECT_EQ(count.made(), 0u);
}

} // namespace
} // namespace locus::federated_test
