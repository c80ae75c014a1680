// The default estimator on simulated flights: it finds its heading, carries over outages, and is never worse for having
// a sensor that lies.
#include "fusion/estimators/inertial_ekf.h"
#include "fusion/estimators/range_ekf.h"
#include "tests/unit/fusion/simulated_flight.h"
#include "tests/unit/fusion/simulated_tag.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <functional>

namespace locus {
namespace {

using test::FlightSettings;
using test::SimulatedFlight;

/// Ranges carry no error but white noise here, so the filter is told of none.
InertialEkfSettings told() {
    InertialEkfSettings settings;
    settings.anchor_error_sigma_m = 0;
    settings.anchor_offset_sigma_m = 0;
    settings.common_range_error_sigma_m = 0;
    settings.robust_scale = 1e6;
    settings.acceleration_noise_mps2_rthz = 0.05;
    settings.angular_rate_noise_radps_rthz = 0.002;
    return settings;
}

struct Score {
    double square_m2 = 0;
    double nees = 0;
    double turned_rad2 = 0;
    int count = 0;
    int with_attitude = 0;
    double rmse_m() const { return std::sqrt(square_m2 / count); }
    double mean_nees() const { return nees / count; }
    double attitude_rmse_rad() const { return std::sqrt(turned_rad2 / with_attitude); }
};

void add(Score& score, const Estimate& estimate, const SimulatedFlight& flight, double t) {
    const Eigen::Vector3d error = vector(estimate.position_site_m) - flight.position_m(t);
    const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> all(estimate.covariance.data());
    const Eigen::Matrix3d covariance = all.topLeftCorner<3, 3>();
    score.square_m2 += error.squaredNorm();
    score.nees += error.dot(covariance.inverse() * error);
    ++score.count;
    const auto& q = estimate.orientation_xyzw;
    if (q[0] == 0 && q[1] == 0 && q[2] == 0 && q[3] == 0) return;
    const double turned = Eigen::Quaterniond(q[3], q[0], q[1], q[2]).angularDistance(flight.body_to_site(t));
    score.turned_rad2 += turned * turned;
    ++score.with_attitude;
}

/// What happens to a run: which samples reach the estimator, and when it is looked at.
struct Plan {
    double until_s = 40;
    double scored_from_s = 20;
    std::function<bool(double)> has_ranges = [](double) { return true; };
    std::function<bool(double)> has_imu = [](double) { return true; };
    std::function<void(ImuSample&, double)> spoil = [](ImuSample&, double) {};
    std::function<bool(double)> scored = [](double) { return true; };
};

Score fly(Estimator& estimator, const Site& site, const FlightSettings& settings, const Plan& plan, unsigned seed) {
    SimulatedFlight flight(site, settings, seed);
    Score score;
    const int steps = static_cast<int>(plan.until_s * settings.imu_hz);
    for (int i = 1; i < steps; ++i) {
        const double t = i / settings.imu_hz;
        Measurement imu = flight.imu(t);
        plan.spoil(*std::get_if<ImuSample>(&imu.observation), t);
        if (plan.has_imu(t)) estimator.update(imu);
        if (i % 2 == 0) { // each of eight anchors 6.25 times a second
            const Measurement range = flight.range(static_cast<std::size_t>(i / 2) % 8, t);
            if (plan.has_ranges(t)) estimator.update(range);
        }
        if (t < plan.scored_from_s || !plan.scored(t)) continue;
        const Estimate estimate = estimator.predict(timestamp_from_s(t));
        EXPECT_EQ(estimate.missing, Missing::nothing) << t;
        add(score, estimate, flight, t);
    }
    return score;
}

TEST(InertialEkf, FindsTheHeadingItWasNotTold) {
    const Site site = test::hall();
    for (const double heading : {-2.8, -1.0, 0.4, 2.3}) {
        FlightSettings settings;
        settings.mounted_heading_rad = heading;
        InertialEkf filter(site, told());
        const Score score = fly(filter, site, settings, {}, 11);
        EXPECT_EQ(score.with_attitude, score.count) << heading;
        EXPECT_LT(score.attitude_rmse_rad(), 0.04) << heading;
        EXPECT_TRUE(filter.track().is_inertial());
    }
}

TEST(InertialEkf, IsNearerThanRangesAloneAndItsBoundHolds) {
    const Site site = test::hall();
    double inertial = 0, plain = 0, nees = 0;
    constexpr int runs = 20;
    for (unsigned seed = 1; seed <= runs; ++seed) {
        InertialEkf filter(site, told());
        RangeEkf without(site, told());
        const Score score = fly(filter, site, {}, {}, seed);
        inertial += score.square_m2 / score.count;
        plain += fly(without, site, {}, {}, seed).rmse_m();
        nees += score.mean_nees() / runs;
    }
    inertial = std::sqrt(inertial / runs);
    plain /= runs;
    std::printf("inertial %.4f m, ranges alone %.4f m, NEES of position %.2f\n", inertial, plain, nees);
    EXPECT_LT(inertial, 0.7 * plain);
    // 20 s hold some 20 independent errors of three numbers: the mean of 400 of them is within 3 +- 0.24 in 95 of 100.
    EXPECT_GT(nees, 2.76);
    EXPECT_LT(nees, 3.24);
}

TEST(InertialEkf, CarriesOverAnOutage) {
    const Site site = test::hall();
    const auto out = [](double t) { return std::fmod(t, 10) > 8; };
    Plan plan;
    plan.until_s = 60;
    plan.has_ranges = [&](double t) { return t < 20 || !out(t); };
    plan.scored = out;
    InertialEkf filter(site, told());
    RangeEkf without(site, told());
    const double inertial = fly(filter, site, {}, plan, 5).rmse_m(), plain = fly(without, site, {}, plan, 5).rmse_m();
    std::printf("in outages of 2 s: inertial %.3f m, ranges alone %.3f m\n", inertial, plain);
    EXPECT_LT(inertial, 0.25 * plain);
}

/// The three kinds of sensor that do harm: shaken until the mean is off, come loose, stuck at one value.
TEST(InertialEkf, IsNeverMuchWorseForASensorThatLies) {
    const Site site = test::hall();
    const std::vector<std::function<void(ImuSample&, double)>> lies{
        [](ImuSample& s, double t) {
            s.specific_force_mps2[0] -= 2.5 + 1.5 * std::sin(0.7 * t);
            s.specific_force_mps2[1] -= 1 + std::sin(1.1 * t);
        },
        [](ImuSample& s, double t) { s.angular_rate_radps = {std::sin(3 * t), 0.5, std::cos(2 * t)}; },
        [](ImuSample& s, double t) {
            if (t > 25) s.specific_force_mps2 = {3, 0, 9.3}, s.angular_rate_radps = {0, 0, 0.3};
        },
    };
    for (std::size_t i = 0; i < lies.size(); ++i) {
        Plan plan;
        plan.spoil = lies[i];
        InertialEkf filter(site, told());
        RangeEkf without(site, told());
        const double lied_to = fly(filter, site, {}, plan, 7).rmse_m(),
                     plain = fly(without, site, {}, plan, 7).rmse_m();
        std::printf("lie %zu: %.3f m, ranges alone %.3f m\n", i, lied_to, plain);
        EXPECT_LT(lied_to, 1.25 * plain) << i;
    }
}

TEST(InertialEkf, ASensorThatIsUnpluggedAndComesBackMakesNoJump) {
    const Site site = test::hall();
    Plan plan;
    plan.until_s = 60;
    plan.has_imu = [](double t) { return t < 25 || t > 30; };
    InertialEkf filter(site, told());
    const Score score = fly(filter, site, {}, plan, 3);
    EXPECT_LT(score.rmse_m(), 0.12);
    EXPECT_EQ(filter.predict(timestamp_from_s(60)).reset_count, 0u);
    EXPECT_TRUE(filter.track().is_inertial()) << "aligned again";
}

TEST(InertialEkf, WithoutASensorAndASecondModelItIsTheRangeFilterToTheBit) {
    const Site site = test::hall();
    Plan plan;
    plan.has_imu = [](double) { return false; };
    InertialEkfSettings settings = told();
    settings.steady_acceleration_sigma_mps2 = 0;
    InertialEkf filter(site, settings);
    RangeEkf plain(site, told());
    fly(filter, site, {}, plan, 3);
    fly(plain, site, {}, plan, 3);
    const Timestamp end = timestamp_from_s(40);
    EXPECT_EQ(filter.predict(end).position_site_m, plain.predict(end).position_site_m);
    EXPECT_EQ(filter.predict(end).covariance, plain.predict(end).covariance);
}

TEST(InertialEkf, SaysWhenItsPositionIsOutOfDate) {
    const Site site = test::hall();
    InertialEkfSettings settings = told();
    settings.dead_reckoning_s = 5;
    Plan plan;
    plan.has_ranges = [](double t) { return t < 30; };
    plan.until_s = 34;
    InertialEkf filter(site, settings);
    fly(filter, site, {}, plan, 3);
    EXPECT_EQ(filter.predict(timestamp_from_s(34.9)).missing, Missing::nothing);
    EXPECT_EQ(filter.predict(timestamp_from_s(35.1)).missing, Missing::fresh_measurements);
}

TEST(InertialEkf, ComesOutOfALongOutageWithoutAReset) {
    const Site site = test::hall();
    Plan plan;
    plan.until_s = 40;
    plan.has_ranges = [](double t) { return t < 30 || t > 36; }; // twice forget_after_s, less than dead_reckoning_s
    InertialEkf filter(site, told());
    fly(filter, site, {}, plan, 3);
    EXPECT_TRUE(filter.track().is_inertial());
    EXPECT_EQ(filter.predict(timestamp_from_s(40)).reset_count, 0u);
}

TEST(InertialEkf, PlanarLeavesTheSensorAside) {
    const Site site = test::hall();
    InertialEkfSettings settings = told();
    settings.planar = true;
    InertialEkf filter(site, settings);
    SimulatedFlight flight(site, {}, 1);
    EXPECT_EQ(filter.update(flight.imu(1)).reason, Exclusion::disabled);
}

TEST(InertialEkf, HeightAndSpeedGoIn) {
    const Site site = test::hall();
    InertialEkf filter(site, told());
    const Measurement early{timestamp_from_s(0), 0, 0, Height{address(9), 1, unknown_f}};
    EXPECT_EQ(filter.update(early).reason, Exclusion::waiting_for_start);
    Plan plan;
    plan.has_imu = [](double) { return false; };
    fly(filter, site, {}, plan, 3);
    const Estimate before = filter.predict(timestamp_from_s(40));
    const Height high{address(9), before.position_site_m[2] + 0.1, 0.01F};
    EXPECT_EQ(filter.update({timestamp_from_s(40), 0, 0, high}).reason, Exclusion::none);
    const Estimate after = filter.predict(timestamp_from_s(40));
    EXPECT_GT(after.position_site_m[2], before.position_site_m[2]);
    EXPECT_LT(after.covariance[14], before.covariance[14]);
    const double speed = std::hypot(after.velocity_site_mps[0], after.velocity_site_mps[1]);
    EXPECT_EQ(filter.update({timestamp_from_s(40), 1, 0, WheelSpeed{address(9), speed + 0.2, 0.05F}}).reason,
              Exclusion::none);
    const Estimate faster = filter.predict(timestamp_from_s(40));
    EXPECT_GT(std::hypot(faster.velocity_site_mps[0], faster.velocity_site_mps[1]), speed);
    EXPECT_NE(faster.kinds_used & (1u << early.observation.index()), 0u) << "the height is among what went in";
}

TEST(InertialEkf, PredictChangesNothingAndACopyGivesTheSameBits) {
    const Site site = test::hall();
    InertialEkf filter(site, told()), other(site, {});
    Plan plan;
    plan.until_s = 15;
    fly(filter, site, {}, plan, 3);
    other.copy_from(filter);
    const auto copy = filter.clone();
    const auto ignored = filter.predict(timestamp_from_s(15.5));
    EXPECT_EQ(ignored.missing, Missing::nothing);
    for (Estimator* e : {static_cast<Estimator*>(&filter), static_cast<Estimator*>(&other), copy.get()}) {
        SimulatedFlight flight(site, {}, 8);
        for (int i = 1; i < 200; ++i) {
            e->update(flight.imu(15 + 0.01 * i));
            e->update(flight.range(static_cast<std::size_t>(i) % 8, 15 + 0.01 * i));
        }
    }
    const Estimate a = filter.predict(timestamp_from_s(17.1)), b = other.predict(timestamp_from_s(17.1)),
                   c = copy->predict(timestamp_from_s(17.1));
    EXPECT_EQ(a.position_site_m, b.position_site_m);
    EXPECT_EQ(a.covariance, b.covariance);
    EXPECT_EQ(a.orientation_xyzw, c.orientation_xyzw);
    EXPECT_EQ(a.covariance, c.covariance);
}

} // namespace
} // namespace locus
