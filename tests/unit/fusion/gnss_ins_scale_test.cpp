// Scales of the inertial sensor in the vehicles' estimator, on simulated drives with stated seeds.
#include "fusion/estimators/gnss_ins.h"
#include "tests/support/heavy.h"
#include "tests/unit/fusion/simulated_drive.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>

namespace locus {
namespace {

constexpr double scales_off = 0.03;
constexpr int gyroscope_up = 5; ///< of the six scales: the one that curves show

GnssInsSettings scale_settings(bool estimate) {
    GnssInsSettings settings;
    settings.non_holonomic = false;
    settings.estimate_scale = estimate;
    settings.scale_sigma = 0.02;
    return settings;
}

struct ScaleCar {
    Site site = test::town();
    test::SimulatedDrive drive;
    GnssIns filter;

    ScaleCar(bool estimate, double off, unsigned seed)
        : drive(site, told(off), seed), filter(site, scale_settings(estimate)) {}

    static test::DriveSettings told(double off) {
        test::DriveSettings settings;
        settings.scale_off = off;
        return settings;
    }
    void run(double until_s, bool satellites) {
        while (drive.time_s() < until_s - 1e-6) {
            drive.move();
            filter.update(drive.imu());
            if (++samples_ % 20 != 0 || !satellites) continue;
            for (std::size_t i = 0; i < 9; ++i) filter.update(drive.satellite(i));
        }
    }
    double error_m() const {
        const Estimate now = filter.predict(drive.now());
        return (Eigen::Map<const Eigen::Vector3d>(now.position_site_m.data()) - drive.position_site_m()).norm();
    }

  private:
    int samples_ = 0;
};

TEST(GnssInsScale, CurvesShowTheGyroscopesScale) {
    double squares = 0;
    constexpr int runs = 10;
    for (unsigned seed = 1; seed <= runs; ++seed) {
        ScaleCar car(true, scales_off, seed);
        car.run(150, true);
        const GnssInsTrack& track = car.filter.track();
        const int at = track.scales_at() + gyroscope_up;
        ASSERT_GE(track.scales_at(), 0);
        const double error = track.state(at) - scales_off, sigma = std::sqrt(track.covariance(at, at));
        squares += error * error / (sigma * sigma * runs);
        EXPECT_LT(sigma, 0.01) << "half of what it began with";
        EXPECT_LT(std::abs(error), 0.015) << seed;
    }
    std::printf("error of the gyroscope's scale over its own sigma, squared, mean: %.2f\n", squares);
    EXPECT_LT(squares, test::chi_square_quantile(runs, 0.995) / runs);
}

/// Root mean square after 20 s without satellites.
double dead_reckoned_m(bool estimate, double off) {
    double squares = 0;
    constexpr int runs = 10;
    for (unsigned seed = 1; seed <= runs; ++seed) {
        ScaleCar car(estimate, off, seed);
        car.run(100, true);
        car.run(120, false);
        squares += car.error_m() * car.error_m() / runs;
    }
    return std::sqrt(squares);
}

TEST(GnssInsScale, CarryFurtherThroughAnOutageWhereTheyAreOffAndNoLessFarWhereTheyAreRight) {
    const double with = dead_reckoned_m(true, scales_off), without = dead_reckoned_m(false, scales_off);
    const double right_with = dead_reckoned_m(true, 0), right_without = dead_reckoned_m(false, 0);
    std::printf("after 20 s alone, scales 3 %% off: %.1f m with, %.1f m without; right: %.1f, %.1f m\n", with, without,
                right_with, right_without);
    EXPECT_LT(with, without);
    EXPECT_LT(right_with, 1.15 * right_without);
}

TEST(GnssInsScale, OffByDefault) {
    ScaleCar car(false, 0, 1);
    car.run(10, true);
    EXPECT_LT(car.filter.track().scales_at(), 0);
}

} // namespace
} // namespace locus
