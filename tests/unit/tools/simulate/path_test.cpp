#include "tools/simulate/path.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace locus::simulate {
namespace {

using Eigen::Vector3d;

const std::vector<Vector3d> rectangle{{0, 0, 1}, {10, 0, 1}, {10, 4, 1}, {0, 4, 1}};

TEST(Path, SharpCornersGoThroughEveryWaypoint) {
    const Path path = Path::through(rectangle, 0);
    EXPECT_NEAR(path.length_m(), 28, 1e-9);
    EXPECT_NEAR((path.at(0).position - rectangle[0]).norm(), 0, 1e-9);
    EXPECT_NEAR((path.at(10).position - rectangle[1]).norm(), 0, 1e-9);
    EXPECT_NEAR((path.at(5).position - Vector3d(5, 0, 1)).norm(), 0, 1e-9);
    EXPECT_NEAR((path.at(5).direction - Vector3d(1, 0, 0)).norm(), 0, 1e-9);
    EXPECT_NEAR((path.at(28 + 12).position - path.at(12).position).norm(), 0, 1e-9);
    EXPECT_NEAR((path.at(-3).position - path.at(25).position).norm(), 0, 1e-9);
}

TEST(Path, RoundedCornersStayNearAndLeaveTheSides) {
    const Path path = Path::through(rectangle, 1);
    EXPECT_LT(path.length_m(), 28);
    double nearest = 1e9;
    for (double s = 0; s < path.length_m(); s += 0.01)
        nearest = std::min(nearest, (path.at(s).position - rectangle[2]).norm());
    EXPECT_GT(nearest, 0.1);
    EXPECT_LT(nearest, 1);
}

TEST(Path, SpeedIsConstant) {
    for (const Path& path : {Path::through(rectangle, 1), Path::figure_of_eight({1, 2, 3}, {20, 8, 1})})
        for (double s = 0; s < path.length_m(); s += 0.37) {
            const double step = (path.at(s + 0.01).position - path.at(s).position).norm();
            ASSERT_LE(step, 0.01 + 1e-9) << s;
            ASSERT_GT(step, 0.0099) << s;
        }
}

TEST(Path, EightCrossesItselfInTheMiddleAndReachesItsSize) {
    const Path path = Path::figure_of_eight({1, 2, 3}, {20, 8, 2});
    Vector3d low = Vector3d::Constant(1e9), high = -low;
    for (double s = 0; s < path.length_m(); s += 0.01) {
        low = low.cwiseMin(path.at(s).position);
        high = high.cwiseMax(path.at(s).position);
    }
    EXPECT_NEAR((low - Vector3d(-9, -2, 2)).norm(), 0, 1e-3);
    EXPECT_NEAR((high - Vector3d(11, 6, 4)).norm(), 0, 1e-3);
    const double half = path.length_m() / 2;
    EXPECT_NEAR((path.at(0).position - path.at(half).position).head<2>().norm(), 0, 1e-6);
}

TEST(Path, OnePointStandsStill) {
    const Path path = Path::through({{1, 2, 3}}, 0.5);
    EXPECT_EQ(path.at(17).position, Vector3d(1, 2, 3));
    EXPECT_EQ(path.at(17).direction, Vector3d::Zero());
}

TEST(Path, AnyWaypointsGiveFinitePointsInTheirBox) {
    EXPECT_TRUE(rc::check([] {
        const auto coordinate = [] { return *rc::gen::inRange(-5, 6) * 1.0; };
        std::vector<Vector3d> points(*rc::gen::inRange<std::size_t>(1, 6));
        for (Vector3d& point : points) point = {coordinate(), coordinate(), coordinate()};
        const Path path = Path::through(points, *rc::gen::element(0.0, 0.5, 100.0));
        const auto [position, direction] = path.at(*rc::gen::inRange(0, 100'000) * 1e-3);
        RC_ASSERT(position.allFinite() && position.cwiseAbs().maxCoeff() <= 5 + 1e-9);
        RC_ASSERT(direction.norm() < 1 + 1e-9);
    }));
}

} // namespace
} // namespace locus::simulate
