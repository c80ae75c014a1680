// Ephemerides into words and back: every value that can be broadcast comes back to the bit.
#include "fusion/gnss/ephemeris_words.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace locus::gnss {
namespace {

constexpr GpsTime sent{2381, 408600};
constexpr int leap_s = 18;

std::optional<Ephemeris> decoded(const std::vector<GnssNavigation>& words) {
    EphemerisCollector collector;
    std::optional<Ephemeris> last;
    for (const auto& one : words) last = collector.add(one, sent);
    return last;
}

/// Whole steps of 2^power * unit in `bits` bits with a sign.
class Steps {
  public:
    double operator()(int bits, int power, double unit = 1) {
        return std::ldexp(std::trunc(std::ldexp(uniform_(random_), bits - 1)), power) * unit;
    }
    double positive(int bits, int power) { return std::abs((*this)(bits, power)); }

  private:
    std::mt19937 random_{20261122};
    std::uniform_real_distribution<double> uniform_{-1, 1};
};

constexpr double half_turn = 3.1415926535898;

KeplerEphemeris any_kepler(Steps& steps, std::uint8_t constellation, std::uint8_t satellite) {
    const bool beidou = constellation == constellation::beidou, galileo = constellation == constellation::galileo;
    const int harmonic_bits = beidou ? 18 : 16, angle = beidou ? -31 : -29, metre = beidou ? -6 : -5;
    KeplerEphemeris e;
    e.constellation = constellation, e.satellite = satellite;
    e.issue = e.issue_clock = static_cast<std::uint16_t>(steps.positive(5, 0));
    e.accuracy = 3, e.health = 1;
    e.week = 2381 - (beidou ? beidou_week_ahead : galileo ? galileo_week_ahead : 0);
    e.toe_s = 410400, e.toc_s = 410400;
    e.clock_s = steps(22, galileo ? -34 : beidou ? -33 : -31);
    e.clock_drift = steps(16, galileo ? -46 : beidou ? -50 : -43);
    e.clock_drift_rate_per_s = steps(6, galileo ? -59 : beidou ? -66 : -55);
    e.group_delay_s[0] = beidou ? steps(10, 0, 1e-10) : steps(8, galileo ? -32 : -31);
    if (galileo || beidou) e.group_delay_s[1] = beidou ? steps(10, 0, 1e-10) : steps(10, -32);
    e.root_a = steps.positive(32, -19), e.eccentricity = steps.positive(32, -33);
    for (double* turns : {&e.mean_anomaly, &e.inclination, &e.node, &e.perigee}) *turns = steps(32, -31, half_turn);
    e.mean_motion_difference = steps(16, -43, half_turn), e.node_rate = steps(24, -43, half_turn);
    e.inclination_rate = steps(14, -43, half_turn);
    for (double* harmonic : {&e.cuc, &e.cus, &e.cic, &e.cis}) *harmonic = steps(harmonic_bits, angle);
    e.crc_m = steps(harmonic_bits, metre), e.crs_m = steps(harmonic_bits, metre);
    return e;
}

TEST(EphemerisWords, OfEllipsesComeBackToTheBit) {
    Steps steps;
    for (int round = 0; round < 100; ++round)
        for (const std::uint8_t constellation :
             {constellation::gps, constellation::qzss, constellation::galileo, constellation::beidou}) {
            const auto e = any_kepler(steps, constellation, static_cast<std::uint8_t>(1 + round % 10));
            const auto again = decoded(encode(e, sent, leap_s));
            ASSERT_TRUE(again) << int{constellation};
            ASSERT_TRUE(std::get<KeplerEphemeris>(*again) == e) << int{constellation};
        }
}

TEST(EphemerisWords, OfGlonassComeBackToTheBit) {
    Steps steps;
    for (int round = 0; round < 100; ++round) {
        GlonassEphemeris e;
        e.satellite = static_cast<std::uint8_t>(1 + round % 24), e.frequency = static_cast<std::int8_t>(round % 14 - 7);
        e.health = static_cast<std::uint8_t>(round % 2), e.age_days = static_cast<std::uint8_t>(round % 32);
        e.reference = {2381, 408600 + 18 - 900.0 * (round % 20)};
        e.clock_s = steps(22, -30), e.clock_drift = steps(11, -40), e.frame_s_in_day = 30.0 * round;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            e.position_m[axis] = steps(27, -11, 1e3), e.velocity_mps[axis] = steps(24, -20, 1e3);
            e.acceleration_mps2[axis] = steps(5, -30, 1e3);
        }
        const auto again = decoded(encode(e, sent, leap_s));
        ASSERT_TRUE(again);
        ASSERT_TRUE(std::get<GlonassEphemeris>(*again) == e) << round;
    }
}

TEST(EphemerisWords, OfWhatCannotBeBroadcastThereAreNone) {
    Steps steps;
    auto e = any_kepler(steps, constellation::gps, 3);
    EXPECT_EQ(encode(e, sent, leap_s).size(), 3u);
    e.root_a = 9000;
    EXPECT_TRUE(encode(e, sent, leap_s).empty());
    e = any_kepler(steps, constellation::gps, 3);
    e.issue_clock = static_cast<std::uint16_t>(e.issue + 1);
    EXPECT_TRUE(encode(e, sent, leap_s).empty()) << "clock and orbit of two issues";
    e = any_kepler(steps, constellation::galileo, 3);
    e.perigee = std::nan("");
    EXPECT_TRUE(encode(e, sent, leap_s).empty());
    e = any_kepler(steps, constellation::beidou, 2);
    EXPECT_EQ(encode(e, sent, leap_s).size(), 10u) << "geostationary: D2";
    EXPECT_TRUE(encode(e, {100, 0}, leap_s).empty()) << "before BeiDou's first week";
    EXPECT_TRUE(encode(any_kepler(steps, constellation::sbas, 120), sent, leap_s).empty());
    EXPECT_TRUE(encode(GlonassEphemeris{}, sent, leap_s).empty()) << "no number";
}

} // namespace
} // namespace locus::gnss
