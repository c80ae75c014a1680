// Ionosphere and troposphere: against a worked example and known zenith delays, and the page of words that tells the
// coefficients.
#include "fusion/gnss/atmosphere.h"
#include "fusion/gnss/ephemeris_book.h"
#include "fusion/gnss/ephemeris_words.h"
#include "fusion/gnss/lnav.h"
#include "fusion/gnss/lnav_ionosphere.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <numbers>

namespace locus::gnss {
namespace {

constexpr double deg = std::numbers::pi / 180;

TEST(Ionosphere, WorkedExample) {
    // 40 N 100 W, satellite at azimuth 210, elevation 20 degrees; widely used to check implementations: 23.784 m.
    const Klobuchar k{{0.3820e-7, 0.1490e-7, -0.1790e-6, 0}, {0.1430e6, 0, -0.3280e6, 0.1130e6}};
    EXPECT_NEAR(ionosphere_l1_m(k, {1000, 593100}, {40, -100, 0}, {210 * deg, 20 * deg}), 23.784, 0.01);
}

TEST(Ionosphere, AtNightItIsFiveNanoseconds) {
    const double midnight_s = 0;
    EXPECT_NEAR(ionosphere_l1_m(usual_ionosphere, {2381, midnight_s}, {40, 0, 0}, {0, 90 * deg}), 5e-9 * light_mps,
                0.002);
}

TEST(Troposphere, AtTheZenithAndDownwards) {
    EXPECT_NEAR(troposphere_m({45, 0, 0}, 90 * deg), 2.307 + 0.12, 0.03) << "dry 2.307 m; wet by 12 hPa of vapour";
    EXPECT_NEAR(troposphere_m({45, 0, 5600}, 90 * deg) / troposphere_m({45, 0, 0}, 90 * deg), 0.5, 0.03);
    EXPECT_NEAR(troposphere_m({45, 0, 0}, 10 * deg) / troposphere_m({45, 0, 0}, 90 * deg), 5.6, 0.05)
        << "Niell's mapping: 5.6";
    EXPECT_EQ(troposphere_m({45, 0, 400e3}, 90 * deg), 0);
}

TEST(IonospherePage, ComesBackFromItsWords) {
    const Klobuchar broadcast{{std::ldexp(10, -30), std::ldexp(2, -27), std::ldexp(-1, -24), std::ldexp(-2, -24)},
                              {std::ldexp(43, 11), std::ldexp(3, 14), std::ldexp(-2, 16), std::ldexp(-5, 16)}};
    const auto words = encode(broadcast, 5, {2051, 45870});
    ASSERT_TRUE(words);
    const auto subframe = lnav_subframe(std::span{words->words}.first(words->word_count));
    ASSERT_TRUE(subframe);
    EXPECT_EQ(lnav_ionosphere(*subframe), broadcast);
    EphemerisBook book{GnssSettings{}};
    EXPECT_FALSE(book.ionosphere());
    book.hear(*words, {2051, 45870});
    EXPECT_EQ(book.ionosphere(), broadcast);
}

TEST(IonospherePage, CoefficientsWithoutRoomGiveNone) {
    EXPECT_FALSE(encode(Klobuchar{{1e-3, 0, 0, 0}, {}}, 5, {2051, 45870}));
}

TEST(Ionosphere, IsNeverNegativeNorAbsurd) {
    EXPECT_TRUE(rc::check([] {
        const auto number = [](double scale) { return *rc::gen::inRange(-1000, 1001) * scale; };
        const Klobuchar k{{number(1e-10), number(1e-9), number(1e-8), number(1e-8)},
                          {number(260), number(2000), number(8000), number(8000)}};
        const Geodetic at{number(0.09), number(0.18), number(5)};
        const LookAngles look{number(3e-3), std::abs(number(1.5e-3))};
        const double delay_m = ionosphere_l1_m(k, {2381, 302400 + number(302)}, at, look);
        RC_ASSERT(delay_m > 0 && delay_m < 1000);
    }));
}

} // namespace
} // namespace locus::gnss
