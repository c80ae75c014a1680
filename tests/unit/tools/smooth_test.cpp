// Smoothing: the mirror gives back what it was shown, two opinions are weighed, and a walk comes out nearer to the
// truth.
#include "tools/replay/smooth.h"

#include "fusion/geometry/vector.h"
#include "tests/unit/fusion/engine_fixture.h"
#include "tools/replay/mirror.h"
#include "tools/replay/ticker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace locus::replay {
namespace {

using engine_test::at;

TEST(Mirror, TwiceIsOnce) {
    const Mirror mirror(at(3), at(10));
    EXPECT_EQ(mirror.time(at(3)), at(10));
    Pose pose;
    pose.estimate.time = at(4);
    pose.estimate.velocity_site_mps = {1, 2, 3};
    pose.estimate.covariance[3] = pose.estimate.covariance[18] = 0.5;
    const Pose back = mirror.pose(pose);
    EXPECT_EQ(back.estimate.time, at(9));
    EXPECT_EQ(back.estimate.velocity_site_mps, (Vec3{-1, -2, -3}));
    EXPECT_EQ(back.estimate.covariance[18], -0.5);
    EXPECT_EQ(mirror.pose(back).estimate.covariance, pose.estimate.covariance);
}

TEST(Mirror, TurnsRatesRoundAndLeavesForcesAlone) {
    const Mirror mirror(at(0), at(10));
    const auto imu = mirror.measurement({at(2), 0, 0, ImuSample{address(1), {1, 2, 9}, {0.1, 0.2, 0.3}}});
    ASSERT_TRUE(imu.has_value());
    const Measurement image = imu.value_or(Measurement{});
    EXPECT_EQ(image.time, at(8));
    const auto* sample = std::get_if<ImuSample>(&image.observation);
    ASSERT_NE(sample, nullptr);
    EXPECT_EQ(sample->specific_force_mps2, (Vec3{1, 2, 9}));
    EXPECT_EQ(sample->angular_rate_radps, (Vec3{-0.1, -0.2, -0.3}));
    EXPECT_FALSE(mirror.measurement({at(2), 0, 0, Arrival{}}).has_value()) << "a free-running clock runs one way";
}

TEST(Smooth, WeighsByHowSureEachIs) {
    Estimate sure, unsure;
    sure.missing = unsure.missing = Missing::nothing;
    sure.position_site_m = {1, 1, 1};
    unsure.position_site_m = {2, 1, 1};
    for (std::size_t i = 0; i < 6; ++i) {
        sure.covariance[7 * i] = i == 2 ? 0 : 0.01; // a height that is known has no variance
        unsure.covariance[7 * i] = i == 2 ? 0 : 0.03;
    }
    const Estimate both = combined(sure, unsure);
    EXPECT_NEAR(both.position_site_m[0], 1.25, 1e-12);
    EXPECT_EQ(both.covariance, sure.covariance);
    EXPECT_EQ(both.position_site_m[2], 1);
}

Vec3 walker_at(double t) { return {3 * std::sin(0.5 * t), 3 * std::cos(0.4 * t), 1.2}; }

EngineSettings hall() {
    EngineSettings settings;
    for (const double x : {-5., 5.})
        for (const double y : {-5., 5.})
            for (const double z : {0.3, 3.})
                settings.site.anchors.push_back({"", address(settings.site.anchors.size()), {x, y, z}});
    return settings;
}

/// Two times a second each anchor, 0.1 m, and a silence of a second.
std::vector<Measurement> walk(const Site& site) {
    std::mt19937 random(4);
    std::normal_distribution<double> noise(0, 0.1);
    std::vector<Measurement> all;
    for (int i = 0; i < 640; ++i) {
        const double t = i / 16.;
        const auto& anchor = site.anchors[static_cast<std::size_t>(i) % 8];
        const double range_m = (vector(walker_at(t)) - vector(anchor.position_site_m)).norm() + noise(random);
        if (t < 20 || t > 21)
            all.push_back({at(t), static_cast<std::uint32_t>(i), 0, Range{anchor.address, address(7), range_m}});
    }
    return all;
}

TEST(Smooth, AWalkComesOutNearerToTheTruth) {
    const EngineSettings settings = hall();
    Engine engine(settings);
    Smoother smoother(settings);
    double live_m2 = 0, smooth_m2 = 0;
    int live = 0, smooth = 0, held = 0;
    const auto error_m2 = [](const Estimate& estimate) {
        return (vector(estimate.position_site_m) - vector(walker_at(to_s(estimate.time)))).squaredNorm();
    };
    Ticker ticker(engine, [&](std::span<const Pose> poses) {
        for (const Pose& pose : poses) {
            if (pose.estimate.missing != Missing::nothing) continue;
            smoother.keep(pose, std::string{engine.target_name(pose.target_index)});
            live_m2 += error_m2(pose.estimate);
            ++live;
        }
    });
    for (const Measurement& measurement : walk(settings.site)) {
        smoother.keep(measurement);
        ticker.take(measurement, measurement.time);
    }
    ticker.finish();
    smoother.finish([&](const Pose& pose, const std::string&) {
        const double m2 = error_m2(pose.estimate);
        smooth_m2 += m2;
        const Vec3 truth = walker_at(to_s(pose.estimate.time)), &p = pose.estimate.position_site_m;
        held += std::hypot(p[0] - truth[0], p[1] - truth[1]) < double{pose.horizontal_error_95_m} ? 1 : 0;
        ++smooth;
    });
    EXPECT_EQ(smooth, live);
    EXPECT_GT(held, 0.95 * smooth);
    EXPECT_EQ(smoother.one_way(), 0u);
    std::printf("live %.3f m, smoothed %.3f m\n", std::sqrt(live_m2 / live), std::sqrt(smooth_m2 / smooth));
    EXPECT_LT(std::sqrt(smooth_m2 / smooth), 0.7 * std::sqrt(live_m2 / live));
}

} // namespace
} // namespace locus::replay
