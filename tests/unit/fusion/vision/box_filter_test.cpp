// The filter of a box: consistent with its own noise, and what it does when it sees no feet.
#include "fusion/vision/box_filter.h"

#include <gtest/gtest.h>

#include <random>

namespace locus::vision {
namespace {

/// A walker's box: 100 px high, 40 wide, moving at `speed` px/s, each edge measured with an error of a tenth of its
/// height.
struct SeenWalker {
    std::mt19937 random;
    double speed_px_per_s;
    double edge_px = 10;

    BoxPx at(double time_s) const { return {static_cast<float>(100 + speed_px_per_s * time_s), 200, 40, 100}; }
    BoxPx seen(double time_s) {
        std::normal_distribution<double> error(0, edge_px);
        const BoxPx box = at(time_s);
        const double left = box.left_px + error(random), right = box.right_px() + error(random);
        const double top = box.top_px + error(random), bottom = box.bottom_px() + error(random);
        return {static_cast<float>(left), static_cast<float>(top), static_cast<float>(right - left),
                static_cast<float>(bottom - top)};
    }
};

constexpr double box_step_s = 0.1;

TEST(BoxFilter, DistanceIsThatOfFourNumbers) {
    // The mean of chi-square of four degrees is 4, its variance 8: over 200 walkers x 30 frames, were they independent,
    // 4 +- 0.04. A real box that neither grows nor turns lies a little below.
    double sum = 0;
    int count = 0;
    for (unsigned seed = 0; seed < 200; ++seed) {
        SeenWalker walker{std::mt19937(seed), 60};
        BoxFilter filter(walker.seen(0), {});
        for (int i = 1; i <= 50; ++i) {
            filter.predict(box_step_s);
            const BoxPx box = walker.seen(i * box_step_s);
            if (i > 20) sum += filter.distance(box).mahalanobis2, ++count;
            filter.update(box);
        }
    }
    EXPECT_GT(sum / count, 3.2);
    EXPECT_LT(sum / count, 4.3);
}

TEST(BoxFilter, KnowsTheFeetBetterThanTheDetectorDoes) {
    double square_px2 = 0, variance_px2 = 0;
    for (unsigned seed = 0; seed < 300; ++seed) {
        SeenWalker walker{std::mt19937(1000 + seed), 60};
        BoxFilter filter(walker.seen(0), {});
        for (int i = 1; i <= 40; ++i) {
            filter.predict(box_step_s);
            filter.update(walker.seen(i * box_step_s));
        }
        square_px2 += std::pow(filter.foot_px().y() - walker.at(4).bottom_px(), 2) / 300;
        variance_px2 += filter.foot_covariance_px2()(1, 1) / 300;
    }
    EXPECT_LT(std::sqrt(square_px2), 6) << "of the 10 px of an edge";
    // 300 draws: the variance's own standard deviation is 8 %. A box that does not change its size is held better than
    // the filter, which allows for change, dares to say.
    EXPECT_LT(square_px2 / variance_px2, 1.25);
    EXPECT_GT(square_px2 / variance_px2, 0.4);
}

TEST(BoxFilter, HiddenFeetStandBelowTheHeadAndAreLessSure) {
    SeenWalker walker{std::mt19937(7), 60};
    BoxFilter with(walker.at(0), {}), without(walker.at(0), {});
    for (int i = 1; i <= 60; ++i) {
        const bool hidden = i > 30;
        BoxPx box = walker.at(i * box_step_s);
        with.predict(box_step_s);
        with.update(box);
        without.predict(box_step_s);
        if (hidden) box.height_px = 50; // only the upper half is seen
        hidden ? without.update_without_feet(box) : without.update(box);
    }
    EXPECT_NEAR(without.foot_px().y(), 300, 3);
    EXPECT_NEAR(without.height_px(), 100, 3);
    EXPECT_GT(without.foot_covariance_px2()(1, 1), 1.5 * with.foot_covariance_px2()(1, 1));
    EXPECT_LT(without.head_covariance_px2()(1, 1), without.foot_covariance_px2()(1, 1));
}

TEST(BoxFilter, TheLongerUnseenTheWiderTheGate) {
    const BoxPx box{100, 200, 40, 100};
    BoxFilter filter(box, {});
    filter.predict(0.1);
    const auto soon = filter.distance({120, 200, 40, 100});
    filter.predict(2);
    const auto late = filter.distance({120, 200, 40, 100});
    EXPECT_LT(late.mahalanobis2, soon.mahalanobis2);
    EXPECT_GT(late.log_doubt, soon.log_doubt);
}

} // namespace
} // namespace locus::vision
