#include "tools/simulate/world.h"

#include <gtest/gtest.h>

#include <numbers>

namespace locus::simulate {
namespace {

using Eigen::Vector3d;

TEST(Wall, ShadowsOnlyWhatPassesThroughIt) {
    const Wall wall{{5, -1, 0}, {5, 1, 2}};
    EXPECT_TRUE(crosses(wall, {0, 0, 1}, {10, 0, 1}));
    EXPECT_TRUE(crosses(wall, {10, 0, 1}, {0, 0, 1}));
    EXPECT_TRUE(crosses(wall, {0, 0, 0}, {10, 0, 3.9}));
    EXPECT_FALSE(crosses(wall, {0, 0, 1}, {4.9, 0, 1})) << "ends before";
    EXPECT_FALSE(crosses(wall, {0, 2.1, 1}, {10, 0.1, 1})) << "passes beside";
    EXPECT_FALSE(crosses(wall, {0, 0, 3}, {10, 0, 2})) << "passes above";
    EXPECT_FALSE(crosses(wall, {0, 0, -1}, {10, 0, -1})) << "passes below";
    EXPECT_FALSE(crosses(wall, {4, -1, 1}, {4, 1, 1})) << "runs beside";
    EXPECT_FALSE(crosses(wall, {5, 0, 0}, {5, 0, 2})) << "straight up";
    EXPECT_TRUE(crosses(Wall{{5, 1, 2}, {5, -1, 0}}, {0, 0, 1}, {10, 0, 1})) << "corners in the other order";
}

Motion along_x() {
    Motion motion;
    motion.speed_mps = 2;
    motion.corner_m = 0;
    motion.waypoints_site_m = {{0, 0, 1}, {100, 0, 1}, {100, 50, 1}};
    return motion;
}

TEST(Target, WalksAtItsSpeedAndFacesWhereItGoes) {
    const Target target(along_x());
    EXPECT_NEAR((target.at(10).position_site_m - Vector3d(20, 0, 1)).norm(), 0, 1e-9);
    EXPECT_NEAR(target.at(10).heading_rad, 0, 1e-9);
    EXPECT_NEAR(target.at(60).heading_rad, std::numbers::pi / 2, 1e-9);
}

TEST(Target, StartsWhereItIsTold) {
    Motion motion = along_x();
    motion.start_m = 30;
    EXPECT_NEAR((Target(motion).at(0).position_site_m - Vector3d(30, 0, 1)).norm(), 0, 1e-9);
}

TEST(Target, AWalkerSwaysNoMoreThanItsAmplitude) {
    Motion motion = along_x();
    const Target smooth(motion);
    motion.sway_m = 0.05;
    const Target walker(motion);
    double most = 0;
    for (double time_s = 0; time_s < 10; time_s += 0.01)
        most = std::max(most, (walker.at(time_s).position_site_m - smooth.at(time_s).position_site_m).norm());
    EXPECT_GT(most, 0.05);
    EXPECT_LT(most, 0.05 * std::numbers::sqrt2);
}

} // namespace
} // namespace locus::simulate
