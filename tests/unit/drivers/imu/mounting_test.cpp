#include "drivers/imu/mounting.h"

#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace locus::imu::mounting_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Vec3 turned(const Vec3& mounting_deg, const Vec3& force) {
    MountingSettings settings;
    settings.mounting_deg = mounting_deg;
    test::Collector sink;
    Mounting{settings}.give({}, force, {}, sink);
    return sink.all<ImuSample>().at(0).specific_force_mps2;
}

void expect_near(const Vec3& got, const Vec3& wanted) {
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(got[i], wanted[i], 1e-12) << i;
}

TEST(Mounting, TurnsTheSensorsAxesIntoTheBodys) {
    expect_near(turned({0, 0, 0}, {1, 2, 3}), {1, 2, 3});
    expect_near(turned({180, 0, 0}, {1, 2, 3}), {1, -2, -3}); // upside down: what it feels up is down
    expect_near(turned({0, 0, 90}, {1, 0, 0}), {0, 1, 0});    // its x looks to the left
    expect_near(turned({0, 90, 0}, {1, 0, 0}), {0, 0, -1});   // its x looks down
    expect_near(turned({90, 0, 0}, {0, 1, 0}), {0, 0, 1});
    expect_near(turned({90, 0, 90}, {0, 1, 0}), {0, 0, 1}); // roll before yaw
}

TEST(Mounting, KeepsLengths) {
    EXPECT_TRUE(rc::check([](std::array<std::int16_t, 3> angles, std::array<std::int16_t, 3> v) {
        const Vec3 force{v[0] / 150.0, v[1] / 150.0, v[2] / 150.0};
        const Vec3 got = turned({angles[0] / 91.0, angles[1] / 91.0, angles[2] / 91.0}, force);
        RC_ASSERT(std::abs(std::hypot(got[0], got[1], got[2]) - std::hypot(force[0], force[1], force[2])) < 1e-9);
    }));
}

TEST(Mounting, BiasAndScaleAreOfTheSensorsAxes) {
    MountingSettings settings;
    settings.tag = address(7);
    settings.mounting_deg = {0, 0, 90};
    settings.accel_scale = {2, 1, 1};
    settings.accel_bias_mps2 = {1, 0, 0};
    settings.gyro_scale = {1, 0.5, 1};
    settings.gyro_bias_dps = {0, 10, 0};
    test::Collector sink;
    Mounting{settings}.give(timestamp_from_ns(5), {4, 0, 0}, {0, 30 * rad_per_deg, 0}, sink, {20, 0, 0});
    const auto sample = sink.all<ImuSample>().at(0);
    expect_near(sample.specific_force_mps2, {0, 6, 0});
    expect_near(sample.angular_rate_radps, {-10 * rad_per_deg, 0, 0});
    EXPECT_NEAR(sample.magnetic_field_ut[1], 20, 1e-5);
    EXPECT_EQ(sample.tag, address(7));
    EXPECT_EQ(sink.items[0].time, timestamp_from_ns(5));
}

TEST(Mounting, ImpossibleReadingsAreRefused) {
    test::Collector sink;
    const Mounting mounting{{}};
    for (const double wrong : {std::nan(""), infinity, -infinity, 320.0}) {
        mounting.give({}, {0, wrong, 0}, {}, sink);
        mounting.give({}, {}, {0, 0, wrong}, sink);
        mounting.give_pressure({}, wrong, sink);
    }
    EXPECT_TRUE(sink.items.empty());
    EXPECT_EQ(sink.refusals, std::vector(12, Refusal::out_of_range));
}

TEST(Mounting, AnUnknownFieldStaysUnknown) {
    test::Collector sink;
    Mounting{{}}.give({}, {}, {}, sink);
    Mounting{{}}.give({}, {}, {}, sink, {1, unknown_f, 1});
    for (const auto& sample : sink.all<ImuSample>()) EXPECT_TRUE(std::isnan(sample.magnetic_field_ut[0]));
}

struct Odd {
    int before = 3;
};
struct Derived : Odd, MountingSettings {
    double rate_hz = 100;
};
constexpr std::array own{option<&Derived::rate_hz>("rate_hz", "Hz", 1, 1000, "Rate.")};
constexpr auto rows = joined(mounting_options<Derived>, own);

TEST(OptionTable, JoinsAFamilysRowsAndADevicesOwn) {
    ASSERT_EQ(rows.size(), 7u);
    EXPECT_EQ(rows.front().name, "tag");
    EXPECT_TRUE(rows.front().required);
    EXPECT_EQ(rows.back().name, "rate_hz");
}

/// The base stands behind another one: its rows must find it there.
TEST(OptionTable, ABasesRowsReachItWhereverItStands) {
    Derived settings;
    rows[0].set(&settings, address(12));
    rows[1].set(&settings, Vec3{1, 2, 3});
    rows[6].set(&settings, 50.0);
    EXPECT_EQ(settings.tag, address(12));
    EXPECT_EQ(settings.mounting_deg, (Vec3{1, 2, 3}));
    EXPECT_EQ(std::get<Address>(rows[0].get(&settings)), address(12));
    EXPECT_EQ(settings.rate_hz, 50);
    EXPECT_EQ(settings.before, 3);
}

} // namespace
} // namespace locus::imu::mounting_test
