// The change of carriers between epochs in the vehicles' estimator, on simulated drives with stated seeds: what it is
// worth, that the filter stays as sure as it may be, and that slips are refused, also those that nobody tells.
#include "fusion/estimators/gnss_ins.h"
#include "fusion/gnss/carrier_change.h"
#include "tests/allocations.h"
#include "tests/support/heavy.h"
#include "tests/unit/fusion/simulated_drive.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <vector>

namespace locus {
namespace {

constexpr double cycle_m = 0.1903; // of L1

test::DriveSettings carrier_drive() {
    test::DriveSettings drive;
    drive.carrier_sigma_m = 0.003;
    return drive;
}

struct CarrierCar {
    Site site = test::town();
    test::SimulatedDrive drive;
    GnssIns filter;
    std::function<void(int epoch)> before_epoch = [](int) {};
    std::array<Verdict, 9> last{};

    CarrierCar(const GnssInsSettings& settings, const test::DriveSettings& told, unsigned seed)
        : drive(site, told, seed), filter(site, settings) {}

    /// Up to `until_s`, with nine satellites five times a second.
    void run(double until_s) {
        while (drive.time_s() < until_s - 1e-6) {
            drive.move();
            filter.update(drive.imu());
            if (++samples_ % 20 != 0) continue;
            before_epoch(samples_ / 20);
            for (std::size_t i = 0; i < last.size(); ++i) last[i] = filter.update(drive.satellite(i));
        }
    }
    Eigen::Vector3d error_m() const {
        return Eigen::Map<const Eigen::Vector3d>(filter.predict(drive.now()).position_site_m.data()) -
               drive.position_site_m();
    }
    Eigen::Vector3d velocity_error_mps() const {
        return Eigen::Map<const Eigen::Vector3d>(filter.predict(drive.now()).velocity_site_mps.data()) -
               drive.velocity_site_mps();
    }

  private:
    int samples_ = 0;
};

/// With a gate that a slip of one cycle meets, and chance does not.
GnssInsSettings plain_settings() {
    GnssInsSettings settings = test::exact_settings();
    settings.gate_false_alarm = 1e-9;
    return settings;
}

struct CarrierScore {
    double velocity_mps = 0, position_m = 0, nees = 0;
};

/// Root mean squares over drives of 45 s, six times in each, and the mean NEES of position and velocity.
CarrierScore score_of(const GnssInsSettings& settings, const test::DriveSettings& told, unsigned runs) {
    constexpr std::array until_s{20.1, 25.1, 30.1, 35.1, 40.1, 45.1};
    const double looks = runs * static_cast<double>(until_s.size());
    CarrierScore score;
    for (unsigned seed = 1; seed <= runs; ++seed) {
        CarrierCar car(settings, told, seed);
        for (const double time_s : until_s) {
            car.run(time_s);
            Eigen::Matrix<double, 6, 1> error;
            error << car.error_m(), car.velocity_error_mps();
            const Estimate estimate = car.filter.predict(car.drive.now());
            const Eigen::Matrix<double, 6, 6> covariance =
                Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(estimate.covariance.data());
            score.nees += test::weighed_square(error, covariance) / looks;
            score.position_m += error.head<3>().squaredNorm() / looks;
            score.velocity_mps += error.tail<3>().squaredNorm() / looks;
        }
    }
    score.position_m = std::sqrt(score.position_m);
    score.velocity_mps = std::sqrt(score.velocity_mps);
    return score;
}

// 40 drives with exact noise. The phases' noise counts in both changes that it is in, which makes the filter shyer than
// it need be, never surer: the NEES of position and velocity stays under the upper end of an honest filter's.
TEST(GnssInsCarrier, MakesTheVelocityBetterAndTheFilterNotTooSure) {
    constexpr unsigned runs = 40;
    GnssInsSettings settings = plain_settings();
    const CarrierScore with = score_of(settings, carrier_drive(), runs);
    settings.use_carrier = false;
    const CarrierScore without = score_of(settings, carrier_drive(), runs);
    std::printf("velocity %.4f m/s with, %.4f without; position %.3f, %.3f m; NEES of 6: %.2f, %.2f (to %.2f)\n",
                with.velocity_mps, without.velocity_mps, with.position_m, without.position_m, with.nees, without.nees,
                test::chi_square_quantile(6 * runs, 0.975) / runs);
    EXPECT_LT(with.velocity_mps, 0.8 * without.velocity_mps);
    EXPECT_LT(with.position_m, 1.02 * without.position_m);
    EXPECT_LT(with.nees, test::chi_square_quantile(6 * runs, 0.975) / runs);
}

TEST(GnssInsCarrier, WorksWithoutAnInertialSensor) {
    GnssInsSettings settings;
    settings.use_imu = false;
    const CarrierScore with = score_of(settings, carrier_drive(), 20);
    settings.use_carrier = false;
    const CarrierScore without = score_of(settings, carrier_drive(), 20);
    std::printf("without a sensor: velocity %.3f m/s with, %.3f without; position %.2f, %.2f m\n", with.velocity_mps,
                without.velocity_mps, with.position_m, without.position_m);
    EXPECT_LT(with.velocity_mps, without.velocity_mps);
    EXPECT_LT(with.position_m, 1.02 * without.position_m);
}

// Ten times a satellite slips by one cycle without a word: each is named and refused, and nothing moves.
TEST(GnssInsCarrier, ASilentSlipIsRefusedAndNamed) {
    CarrierCar slipping({}, carrier_drive(), 3), clean({}, carrier_drive(), 3);
    int slipped = 0;
    slipping.before_epoch = [&](int epoch) {
        if (epoch >= 150 && epoch < 200 && epoch % 5 == 0)
            slipping.drive.slip(static_cast<std::size_t>(epoch / 5 % 9), cycle_m);
        if (epoch > 150 && epoch <= 200 && epoch % 5 == 2) // its verdict came with the epoch after it
            slipped += slipping.last[static_cast<std::size_t>(epoch / 5 % 9)].carrier == CarrierUse::slipped;
    };
    slipping.run(45);
    clean.run(45);
    EXPECT_EQ(slipped, 10);
    EXPECT_LT((slipping.error_m() - clean.error_m()).norm(), 0.05);
    EXPECT_LT(slipping.velocity_error_mps().norm(), 0.2);
    for (const Verdict& verdict : clean.last) EXPECT_EQ(verdict.carrier, CarrierUse::used);
}

// Without a slip next to nothing is refused, though the clock wanders by more than the carriers' noise.
TEST(GnssInsCarrier, RefusesNextToNothingWhereNothingSlips) {
    CarrierCar car({}, carrier_drive(), 8);
    int refused = 0, used = 0;
    car.before_epoch = [&](int) {
        for (const Verdict& verdict : car.last) {
            refused += verdict.carrier == CarrierUse::slipped;
            used += verdict.carrier == CarrierUse::used;
        }
    };
    car.run(60);
    EXPECT_LT(refused, used / 50);
    EXPECT_GT(used, 2500);
}

TEST(GnssInsCarrier, ALockThatBeganAnewIsNotUsed) {
    CarrierCar car({}, carrier_drive(), 4);
    car.before_epoch = [&](int epoch) {
        if (epoch == 200) car.drive.lose_lock(2);
    };
    car.run(40.21);
    EXPECT_EQ(car.last[2].carrier, CarrierUse::new_lock);
    EXPECT_EQ(car.last[3].carrier, CarrierUse::used);
    car.run(40.61);
    EXPECT_EQ(car.last[2].carrier, CarrierUse::used);
    EXPECT_LT(car.velocity_error_mps().norm(), 0.2);
}

TEST(GnssInsCarrier, SurvivesAReceiverThatSetsItsClock) {
    CarrierCar car({}, carrier_drive(), 5);
    car.run(40);
    car.drive.set_clock(-299792.458);
    car.run(45);
    EXPECT_EQ(car.last[0].carrier, CarrierUse::used);
    EXPECT_LT(car.error_m().norm(), 3);
    EXPECT_LT(car.velocity_error_mps().norm(), 0.2);
}

TEST(GnssInsCarrier, SwitchedOffItIsAsIfThereWereNone) {
    GnssInsSettings off;
    off.use_carrier = false;
    CarrierCar car(off, carrier_drive(), 6);
    car.run(20);
    EXPECT_EQ(car.last[0].carrier, CarrierUse::none);
}

TEST(GnssInsCarrier, AProspectKnowsTheEpochThatIsNotOverYet) {
    CarrierCar car({}, carrier_drive(), 7);
    car.run(30);
    const Estimate ahead = car.filter.predict(car.drive.now() + duration_from_s(0.01));
    car.drive.move();
    car.filter.update(car.drive.stamped(Pressure{address(1), 101325})); // nothing but time goes on
    const Estimate then = car.filter.predict(car.drive.now());
    for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(ahead.position_site_m[i], then.position_site_m[i], 1e-3);
}

TEST(GnssInsCarrier, ACopyGoesOnToTheSameBitsAndNothingIsAllocated) {
    CarrierCar car({}, carrier_drive(), 9);
    car.run(30);
    GnssIns copy(car.site, {});
    const test::AllocationCount allocations;
    copy.copy_from(car.filter);
    car.drive.move();
    const Measurement imu = car.drive.imu();
    for (GnssIns* one : {&car.filter, &copy}) one->update(imu);
    const Estimate here = car.filter.predict(car.drive.now()), there = copy.predict(car.drive.now());
    EXPECT_EQ(allocations.made(), 0U);
    EXPECT_EQ(here.position_site_m, there.position_site_m);
    EXPECT_EQ(here.covariance, there.covariance);
}

// ---- an epoch's changes against one another

std::vector<gnss::CarrierEquation> carrier_changes(std::size_t count, double slip_m, std::size_t which) {
    std::vector<gnss::CarrierEquation> list;
    for (std::size_t i = 0; i < count; ++i) {
        const double azimuth = 2.4 * static_cast<double>(i), elevation = 0.3 + 0.13 * static_cast<double>(i);
        const Eigen::Vector3d sight(std::cos(elevation) * std::sin(azimuth), std::cos(elevation) * std::cos(azimuth),
                                    std::sin(elevation));
        Eigen::Vector4d row;
        row << -sight, 1;
        gnss::CarrierEquation one;
        one.row = row;
        one.residual_m = row.dot(Eigen::Vector4d(0.4, -0.2, 0.1, 30)) + (i == which ? slip_m : 0);
        one.variance_m2 = 1e-4;
        list.push_back(one);
    }
    return list;
}

TEST(CarrierChange, TheOneThatSlippedIsFoundAmongNine) {
    for (std::size_t which = 0; which < 9; ++which) {
        auto list = carrier_changes(9, cycle_m, which);
        gnss::leave_out_slips(list, 3.1);
        for (std::size_t i = 0; i < list.size(); ++i) EXPECT_EQ(list[i].agrees, i != which) << which << ' ' << i;
    }
}

TEST(CarrierChange, WithoutEnoughToTellWhichAllAreLeftOutAndWithNoneToTestAllStay) {
    auto six = carrier_changes(6, 1, 0), four = carrier_changes(4, 1, 0), good = carrier_changes(6, 0, 0);
    gnss::leave_out_slips(six, 3.1);
    gnss::leave_out_slips(four, 3.1);
    gnss::leave_out_slips(good, 3.1);
    for (const auto& one : six) EXPECT_FALSE(one.agrees);
    for (const auto& one : four) EXPECT_TRUE(one.agrees);
    for (const auto& one : good) EXPECT_TRUE(one.agrees);
}

TEST(CarrierChange, ALockIsUnbrokenWhenItIsOlderThanTheEpochBefore) {
    const auto unbroken = [](float before_s, float now_s, double dt_s) {
        gnss::CarrierSight before, now;
        before.lock_s = before_s;
        now.lock_s = now_s;
        return gnss::is_unbroken(before, now, dt_s);
    };
    EXPECT_TRUE(unbroken(0, 0.25F, 0.25)) << "it began with the epoch before";
    EXPECT_TRUE(unbroken(64.5F, 64.5F, 0.25)) << "u-blox counts no further";
    EXPECT_FALSE(unbroken(10, 0.1F, 0.25)) << "it fell";
    EXPECT_FALSE(unbroken(0, 0, 0.25)) << "half a cycle in doubt";
    EXPECT_FALSE(unbroken(0, 30, 0.25)) << "known only now";
}

TEST(CarrierChange, MustDifferFromTheirDopplersAlike) {
    gnss::CarrierSight before, now;
    before.sigma_m = now.sigma_m = 0.003;
    before.rate_mps = 500;
    now.rate_mps = 501;
    before.rate_sigma_mps = now.rate_sigma_mps = 0.07;
    now.carrier_m = 0.25 * 500.5 + cycle_m;
    EXPECT_NEAR(gnss::beyond_doppler_m(before, now, 0.25), cycle_m, 1e-9);
    EXPECT_NEAR(gnss::beyond_doppler_sigma_m(before, now, 0.25), 0.0135, 1e-4);
    auto five = carrier_changes(5, 0, 0), two = carrier_changes(2, 0, 0);
    for (auto& one : five) {
        one.beyond_m = 0.1; // the clock ran
        one.beyond_sigma_m = 0.0135;
    }
    five[1].beyond_m += cycle_m;
    five[2].beyond_m = std::nan(""); // has no Doppler
    two[0].beyond_m = cycle_m;
    gnss::leave_out_against_doppler(five, 3.3);
    gnss::leave_out_against_doppler(two, 3.3);
    for (std::size_t i = 0; i < five.size(); ++i) EXPECT_EQ(five[i].agrees, i != 1) << i;
    for (const auto& one : two) EXPECT_TRUE(one.agrees);
}

} // namespace
} // namespace locus
