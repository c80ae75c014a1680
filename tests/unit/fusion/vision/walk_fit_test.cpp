// A camera calibrated by walking: simulated, so that view and clock are known.
#include "fusion/vision/survey/walk_fit.h"

#include "tests/unit/fusion/vision/simulated_walk.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace locus::vision::survey {
namespace {

using vision_test::looking_down;
using vision_test::simulate_walk;
using vision_test::WalkOptions;

const WalkSettings settings{-2, 2, 0.1, {1280, 720}};

WalkFit fitted(const WalkOptions& options, const std::optional<Lens>& lens, const Lens& true_lens) {
    const auto walk = simulate_walk(looking_down(true_lens), options);
    return fit_walk(walk.feet, TaggedPath(walk.path), lens, settings);
}

/// Root mean square over the floor that was walked, m.
double floor_error_m(const FloorView& view, const Lens& true_lens) {
    const FloorView truth = looking_down(true_lens);
    double square = 0;
    int count = 0;
    for (double x_m = -2; x_m <= 2; x_m += 1)
        for (double y_m = 5; y_m <= 12; y_m += 1)
            if (const auto pixel = pixel_of_floor(truth, {x_m, y_m})) {
                const auto there = foot_on_floor(view, {*pixel, Eigen::Matrix2d::Identity()});
                square += there ? (there->position_site_m - Eigen::Vector2d(x_m, y_m)).squaredNorm() : 1e4;
                ++count;
            }
    return std::sqrt(square / count);
}

/// Squared error of the offset over its variance, mean of many walks: 1 is right.
TEST(WalkFit, TheOffsetIsAsSureAsItSays) {
    double sum = 0, floor_m = 0, sigma_s = 0;
    constexpr int walks = 12;
    for (unsigned seed = 1; seed <= walks; ++seed) {
        const double offset_s = -1.7 + 0.3 * seed;
        const WalkFit walk = fitted({.seed = seed, .offset_s = offset_s}, std::nullopt, vision_test::plain_pinhole());
        ASSERT_EQ(walk.trouble, WalkTrouble::none) << seed;
        const double test = (walk.offset_s - offset_s) / walk.offset_sigma_s;
        EXPECT_LT(std::abs(test), 3) << seed << ": " << walk.offset_s << " for " << offset_s;
        sum += test * test / walks;
        sigma_s += walk.offset_sigma_s / walks;
        floor_m += floor_error_m(walk.fit.view, vision_test::plain_pinhole()) / walks;
    }
    std::printf("offset: squared error over variance %.2f, sigma %.4f s; floor error %.3f m\n", sum, sigma_s, floor_m);
    EXPECT_LT(sum, 2.2); // of 12: 1 +- 0.41, three of these
    EXPECT_GT(sum, 0.2) << "the sigma says nothing when it is far too large";
    EXPECT_LT(sigma_s, 0.05);
    EXPECT_LT(floor_m, 0.1);
}

TEST(WalkFit, OnlyThePersonWhoseMotionFitsIsTaken) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const WalkFit walk =
            fitted({.seed = seed, .offset_s = -0.8, .others = 3}, std::nullopt, vision_test::plain_pinhole());
        ASSERT_EQ(walk.trouble, WalkTrouble::none) << seed;
        EXPECT_LT(std::abs(walk.offset_s + 0.8), 3 * walk.offset_sigma_s) << seed;
        EXPECT_LT(floor_error_m(walk.fit.view, vision_test::plain_pinhole()), 0.2) << seed;
        EXPECT_LT(walk.used.size(), walk.matched / 2) << "feet of one of four";
    }
}

TEST(WalkFit, EveryLensThatIsKnownGivesACamera) {
    for (const Lens& lens : vision_test::lenses()) {
        if (std::holds_alternative<TsaiLens>(lens)) continue; // other image sizes
        const WalkFit walk = fitted({.seed = 7, .offset_s = 1.1, .others = 1}, lens, lens);
        ASSERT_EQ(walk.trouble, WalkTrouble::none);
        EXPECT_LT(std::abs(walk.offset_s - 1.1), 3 * walk.offset_sigma_s);
        const Eigen::Vector3d error_m = std::get<Camera>(walk.fit.view).position_site_m() - Eigen::Vector3d(0, 0, 4);
        const Eigen::Vector3d sigma_m = position_sigma_m(walk.fit);
        EXPECT_LT(error_m.cwiseQuotient(sigma_m).cwiseAbs().maxCoeff(), 4) << error_m.transpose();
        EXPECT_LT(sigma_m.maxCoeff(), 0.3);
    }
}

TEST(WalkFit, AWalkOnALineIsRefused) {
    EXPECT_EQ(fitted({.on_a_line = true}, std::nullopt, vision_test::plain_pinhole()).trouble, WalkTrouble::no_area);
}

TEST(WalkFit, PeopleWhoAreNotTheTaggedOneAreRefused) {
    for (const unsigned seed : {3U, 1002U, 1003U, 1030U}) { // the last three fit somebody for half a minute
        auto walk =
            simulate_walk(looking_down(vision_test::plain_pinhole()), {.seed = seed, .others = seed == 3 ? 3U : 2U});
        std::erase_if(walk.feet, [](const SeenFoot& foot) { return foot.track < 100; });
        const WalkFit fit = fit_walk(walk.feet, TaggedPath(walk.path), std::nullopt, settings);
        EXPECT_EQ(fit.trouble, WalkTrouble::nobody) << fit.used.size() << " of " << fit.matched;
    }
}

TEST(WalkFit, WithoutPosesAtThatTimeItSaysSo) {
    auto walk = simulate_walk(looking_down(vision_test::plain_pinhole()), {});
    for (SeenFoot& foot : walk.feet) foot.time_s += 5000;
    EXPECT_EQ(fit_walk(walk.feet, TaggedPath(walk.path), std::nullopt, settings).trouble, WalkTrouble::no_pose);
    EXPECT_EQ(fit_walk({}, TaggedPath({}), std::nullopt, settings).trouble, WalkTrouble::no_pose);
}

} // namespace
} // namespace locus::vision::survey
