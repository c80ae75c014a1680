// Tags that hear each other, in radio_particles: near whom a camera sees is where his neighbour is.
#include "fusion/engine.h"
#include "tests/allocations.h"
#include "tests/unit/fusion/radio/radio_hall.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace locus {
namespace {

using test::RadioHall;

/// Heard by somebody who is surely at `at_m`, in the mean as the path loss says.
SignalStrength from_peer(const RadioHall& hall, const Eigen::Vector2d& at_m) {
    const double distance_m = std::max(0.5, (hall.walker.position_m().head<2>() - at_m).norm());
    SignalStrength strength;
    strength.transmitter = address(700);
    strength.receiver = address(1);
    strength.rssi_dbm = static_cast<float>(-50 - 20 * std::log10(distance_m));
    strength.other = {{at_m.x(), at_m.y(), 1.2}, {0.04F, 0, 0, 0.04F, 0, 0.04F}};
    return strength;
}

/// Somebody who walks a metre beside him all the time.
double beside_m(bool is_heard) {
    double sum_m = 0;
    constexpr unsigned seeds = 4;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        RadioHall hall(true, seed, false);
        for (int second = 0; second < 60; ++second) {
            hall.walk(1);
            const Eigen::Vector2d beside = hall.walker.position_m().head<2>() + Eigen::Vector2d(0.7, 0.7);
            if (is_heard) hall.filter.update({hall.walker.time(), 0, 0, from_peer(hall, beside)});
        }
        sum_m += hall.mean_m() / seeds;
    }
    return sum_m;
}

TEST(RadioPeers, WhoIsNearSomebodyKnownIsKnownBetter) {
    const double alone_m = beside_m(false), together_m = beside_m(true);
    std::printf("alone %.2f m, beside somebody who is seen %.2f m\n", alone_m, together_m);
    EXPECT_LT(together_m, 0.9 * alone_m);
}

TEST(RadioPeers, AreBeaconsUnknownWhereNobodyKnowsWhereTheyAre) {
    RadioHall hall;
    hall.walk(5);
    SignalStrength strength = from_peer(hall, {5, 5});
    strength.other = {};
    EXPECT_EQ(hall.filter.update({hall.walker.time(), 0, 0, strength}).reason, Exclusion::unknown_beacon);
}

TEST(RadioPeers, DoNotBeginAPose) {
    RadioHall hall;
    EXPECT_EQ(hall.filter.update({hall.walker.time(), 0, 0, from_peer(hall, {5, 5})}).reason,
              Exclusion::waiting_for_start);
}

TEST(RadioPeers, ManyOfThemCostNoMemory) {
    RadioHall hall;
    hall.walk(5);
    SignalStrength strength = from_peer(hall, {5, 5});
    const test::AllocationCount count;
    for (unsigned i = 0; i < 100; ++i) {
        strength.transmitter = address(700 + i);
        EXPECT_EQ(hall.filter.update({hall.walker.time(), 0, 0, strength}).reason, Exclusion::none);
    }
    EXPECT_EQ(count.made(), 0U);
    EXPECT_LT(hall.error_m(), 20);
}

} // namespace
} // namespace locus
