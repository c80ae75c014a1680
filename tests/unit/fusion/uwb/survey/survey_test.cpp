// Self-survey against anchors whose places are known to the test: exact distances give them back, noisy ones within
// what the survey says of itself, blocked ones are named, and what distances cannot tell is asked or refused.
#include "fusion/uwb/survey/survey.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace locus::uwb::survey {
namespace {

using testing::ElementsAre;

/// A hall with anchors under the roof and near the floor, none of it symmetric.
Positions hall() {
    Positions at_m(8, 3);
    at_m << 0, 0, 0.3, 14, 0, 2.9, 13.5, 9, 0.4, 0.5, 8.5, 3.1, 7, -0.5, 3, 14.5, 4.5, 1.5, 6.5, 9.5, 0.2, -0.5, 4, 2;
    return at_m;
}

class Measured {
  public:
    explicit Measured(Positions at_m, unsigned seed = 1) : at_m_(std::move(at_m)), random_(seed) {
        task.stations.resize(static_cast<std::size_t>(at_m_.rows()));
    }

    Measured& all_pairs(double noise_m) {
        for (std::size_t a = 0; a < task.stations.size(); ++a)
            for (std::size_t b = a + 1; b < task.stations.size(); ++b) pair(a, b, noise_m);
        return *this;
    }
    Measured& pair(std::size_t a, std::size_t b, double noise_m) {
        task.pairs.push_back({a, b, distance_m(a, b) + noise_m * normal_(random_), std::max(noise_m, 0.01)});
        return *this;
    }
    Measured& known(std::initializer_list<std::size_t> stations) {
        for (const std::size_t i : stations) task.stations[i].known_site_m = place(i);
        return *this;
    }
    Measured& heights() {
        for (std::size_t i = 0; i < task.stations.size(); ++i) task.stations[i].height_site_m = place(i).z();
        return *this;
    }
    PairRange& between(std::size_t a, std::size_t b) {
        return *std::ranges::find_if(task.pairs, [&](const auto& pair) { return pair.a == a && pair.b == b; });
    }
    Measured& without(std::size_t a, std::size_t b) {
        std::erase_if(task.pairs, [&](const auto& pair) { return pair.a == a && pair.b == b; });
        return *this;
    }
    Eigen::Vector3d place(std::size_t i) const { return at_m_.row(static_cast<Eigen::Index>(i)).transpose(); }
    double distance_m(std::size_t a, std::size_t b) const { return (place(a) - place(b)).norm(); }
    const Positions& truth_m() const { return at_m_; }

    Task task;

  private:
    Positions at_m_;
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
};

double worst_m(const Image& image, const Positions& truth_m) {
    return (image.adjustment.position_m - truth_m).rowwise().norm().maxCoeff();
}

TEST(Survey, KnownAnchorsOutOfOnePlaneLeaveNothingToAsk) {
    Measured m(hall());
    const Survey result = survey(m.all_pairs(0).known({0, 1, 2, 3}).task);
    ASSERT_EQ(result.trouble, Trouble::none);
    ASSERT_EQ(result.images.size(), 1u);
    EXPECT_LT(worst_m(result.images[0], m.truth_m()), 1e-4);
    EXPECT_EQ(result.images[0].adjustment.redundancy, 28 - 12);
    EXPECT_TRUE(result.images[0].doubts.empty());
}

TEST(Survey, ThreeKnownAnchorsLeaveTheMirrorImageInTheirPlane) {
    Measured m(hall());
    const Survey result = survey(m.all_pairs(0).known({0, 1, 2}).task);
    ASSERT_EQ(result.images.size(), 2u);
    ASSERT_TRUE(result.mirror.has_value());
    const double first_m = worst_m(result.images[0], m.truth_m()), second_m = worst_m(result.images[1], m.truth_m());
    EXPECT_LT(std::min(first_m, second_m), 1e-4);
    EXPECT_GT(std::max(first_m, second_m), 1.0);
}

TEST(Survey, MirrorImagesAreOrderedLeftAndAboveFirst) {
    Positions at_m(4, 3);
    at_m << 0, 0, 0, 10, 0, 0, 0, 8, 0, 2, 3, 4;
    Measured m(at_m);
    const Survey above = survey(m.all_pairs(0).known({0, 1, 2}).task);
    ASSERT_EQ(above.images.size(), 2u);
    EXPECT_TRUE(above.mirror->by_height); // NOLINT(bugprone-unchecked-optional-access): two images have one
    EXPECT_EQ(above.mirror->station, 3u); // NOLINT(bugprone-unchecked-optional-access)
    EXPECT_NEAR(above.images[0].adjustment.position_m(3, 2), 4, 1e-4);
    EXPECT_NEAR(above.images[1].adjustment.position_m(3, 2), -4, 1e-4);
    Measured flat(at_m);
    const Survey left = survey(flat.all_pairs(0).known({0, 1}).heights().task);
    ASSERT_EQ(left.images.size(), 2u);
    EXPECT_FALSE(left.mirror->by_height); // NOLINT(bugprone-unchecked-optional-access)
    EXPECT_NEAR(left.images[0].adjustment.position_m(2, 1), 8, 1e-4);
    EXPECT_NEAR(left.images[1].adjustment.position_m(2, 1), -8, 1e-4);
}

TEST(Survey, WithoutKnownAnchorsTheFrameIsTheConvention) {
    Measured m(hall());
    const Survey result = survey(m.all_pairs(0).task);
    ASSERT_EQ(result.trouble, Trouble::none);
    EXPECT_TRUE(result.by_convention);
    EXPECT_THAT(result.frame, ElementsAre(0u, 1u, 2u));
    ASSERT_EQ(result.images.size(), 2u);
    for (const Image& image : result.images) {
        const Positions& at_m = image.adjustment.position_m;
        EXPECT_TRUE(at_m.row(0).isZero());
        EXPECT_NEAR(at_m(1, 0), m.distance_m(0, 1), 1e-4);
        EXPECT_TRUE(at_m.row(1).tail<2>().isZero());
        EXPECT_GT(at_m(2, 1), 1);
        EXPECT_EQ(at_m(2, 2), 0);
        for (const PairRange& pair : m.task.pairs) {
            const auto a = static_cast<Eigen::Index>(pair.a), b = static_cast<Eigen::Index>(pair.b);
            EXPECT_NEAR((at_m.row(a) - at_m.row(b)).norm(), pair.range_m, 1e-4);
        }
    }
}

TEST(Survey, ThirdOnTheRightTurnsTheConventionOver) {
    Measured m(hall());
    m.all_pairs(0).task.third_on_right = true;
    for (const Image& image : survey(m.task).images) EXPECT_LT(image.adjustment.position_m(2, 1), -1);
}

TEST(Survey, PairsThatAreMissingAreDoneWithout) {
    Measured m(hall());
    m.all_pairs(0.02).known({0, 1, 2, 3}).without(4, 6).without(5, 7).without(0, 5).without(3, 4).without(1, 7);
    const Survey result = survey(m.without(0, 6).without(2, 4).task);
    ASSERT_EQ(result.images.size(), 1u);
    EXPECT_LT(worst_m(result.images[0], m.truth_m()), 0.15);
}

// Noise of 0.1 m: errors in units of what the survey says, squared and summed over 12 unknowns, have a mean of 12.
// 50 surveys: the mean lies within 12 +- 2.6 * sqrt(2 * 12 / 50) = +-1.8 of it; robust weights and the widening by
// large residuals may only make the survey more careful, by 15 % at most.
TEST(Survey, IsAsSureAsItSays) {
    double sum = 0;
    constexpr int surveys = 50;
    for (unsigned seed = 0; seed < surveys; ++seed) {
        Measured m(hall(), seed);
        const Survey result = survey(m.all_pairs(0.1).known({0, 1, 2, 3}).task);
        ASSERT_EQ(result.images.size(), 1u) << seed;
        const Adjustment& adjusted = result.images[0].adjustment;
        const Positions error_m = adjusted.position_m - m.truth_m();
        sum += error_m.bottomRows<4>().cwiseQuotient(adjusted.sigma_m.bottomRows<4>()).squaredNorm();
    }
    const double mean = sum / surveys;
    std::printf("mean of 12 squared errors over their variances: %.2f\n", mean);
    EXPECT_LE(mean, 13.8);
    EXPECT_GE(mean, 0.85 * 10.2);
}

TEST(Survey, BlockedPairsAreNamedAndDoLittle) {
    Measured m(hall(), 3);
    m.all_pairs(0.05).known({0, 1, 2, 3});
    m.between(4, 6).range_m += 2.5;
    m.between(1, 5).range_m += 1.5;
    const Survey result = survey(m.task);
    ASSERT_EQ(result.images.size(), 1u);
    EXPECT_LT(worst_m(result.images[0], m.truth_m()), 0.25);
    Measured free = m;
    for (Station& station : free.task.stations) station = {};
    EXPECT_LT(survey(free.task).images[0].adjustment.cost, 80) << "63 of the two, 0.9 of each other's redundancy";
    for (std::size_t i = 0; i < m.task.pairs.size(); ++i) {
        const auto& pair = m.task.pairs[i];
        const bool blocked = (pair.a == 4 && pair.b == 6) || (pair.a == 1 && pair.b == 5);
        EXPECT_EQ(result.images[0].adjustment.pairs[i].weight < 0.1, blocked) << pair.a << " " << pair.b;
    }
}

TEST(Survey, AnchorsInOnePlaneHaveNoSureHeight) {
    Positions at_m = hall();
    at_m.col(2).setConstant(3);
    Measured m(at_m);
    const Survey result = survey(m.all_pairs(0.05).known({0, 1, 2}).task);
    ASSERT_FALSE(result.images.empty());
    EXPECT_GT(result.images[0].adjustment.sigma_m.col(2).maxCoeff(), 0.3)
        << "a centimetre of noise lifts it by a metre";
    Measured with_heights(at_m);
    const Survey flat = survey(with_heights.all_pairs(0.05).heights().known({0, 1, 2}).task);
    ASSERT_EQ(flat.images.size(), 1u);
    EXPECT_LT(worst_m(flat.images[0], at_m), 0.15);
    EXPECT_TRUE(flat.images[0].adjustment.sigma_m.col(2).isZero());
}

TEST(Survey, AnAnchorWithTwoPlacesIsAskedAbout) {
    Measured m(hall());
    m.all_pairs(0.01).known({0, 1, 2, 3});
    for (const std::size_t other : {3u, 4u, 5u, 6u}) m.without(other, 7); // 7 hears 0, 1 and 2 alone
    const Survey result = survey(m.task);
    ASSERT_EQ(result.images.size(), 2u);
    EXPECT_EQ(result.mirror->station, 7u); // NOLINT(bugprone-unchecked-optional-access): two images have one
    const auto off_m = [&](const Image& image) { return worst_m(image, m.truth_m()); };
    EXPECT_LT(std::min(off_m(result.images[0]), off_m(result.images[1])), 0.1);
    for (const Image& image : result.images) EXPECT_TRUE(image.doubts.empty());
}

TEST(Survey, OneQuestionDoesNotSettleTwoAnchors) {
    Measured m(hall());
    m.all_pairs(0.01).known({0, 1, 2, 3});
    for (const std::size_t other : {3u, 4u, 5u, 6u}) m.without(other, 7); // 7 hears 0, 1 and 2 alone
    for (const std::size_t other : {1u, 4u, 5u}) m.without(other, 6);     // 6 hears 0, 2 and 3 alone
    const Survey result = survey(m.task);
    ASSERT_EQ(result.images.size(), 2u);
    for (const Image& image : result.images) {
        ASSERT_EQ(image.doubts.size(), 1u);
        EXPECT_NE(image.doubts[0].station, result.mirror->station); // NOLINT(bugprone-unchecked-optional-access)
    }
}

TEST(Survey, GroupsThatNothingJoinsAreRefused) {
    Measured m(hall());
    for (const auto& [a, b] : {std::pair{0u, 1u}, {0u, 2u}, {1u, 2u}, {0u, 3u}, {1u, 3u}, {2u, 3u}}) m.pair(a, b, 0);
    for (const auto& [a, b] : {std::pair{4u, 5u}, {5u, 6u}, {6u, 7u}}) m.pair(a, b, 0);
    const Survey result = survey(m.task);
    EXPECT_EQ(result.trouble, Trouble::disconnected);
    EXPECT_THAT(result.about, ElementsAre(0u, 4u));
}

TEST(Survey, RefusesWhatCannotBe) {
    EXPECT_EQ(survey({}).trouble, Trouble::too_few_stations);
    Measured three(hall().topRows(3));
    EXPECT_EQ(survey(three.all_pairs(0).task).trouble, Trouble::too_few_stations);
    Measured few(hall());
    EXPECT_EQ(survey(few.all_pairs(0).known({0, 1}).task).trouble, Trouble::known_too_few);
    Positions line_m(5, 3);
    line_m << 0, 0, 1, 5, 0, 1, 10, 0, 1, 3, 4, 2, 8, 3, 0;
    Measured line(line_m);
    EXPECT_EQ(survey(line.all_pairs(0).known({0, 1, 2}).task).trouble, Trouble::known_in_line);
    line_m.col(1).setZero();
    line_m.col(2).setConstant(1);
    Measured all_in_line(line_m);
    EXPECT_EQ(survey(all_in_line.all_pairs(0).task).trouble, Trouble::frame_in_line);
    Measured poor(hall());
    poor.all_pairs(0);
    for (const std::size_t other : {0u, 1u, 2u, 3u, 4u, 5u}) poor.without(other, 7);
    const Survey refused = survey(poor.task);
    EXPECT_EQ(refused.trouble, Trouble::too_few_pairs);
    EXPECT_THAT(refused.about, ElementsAre(7u));
}

} // namespace
} // namespace locus::uwb::survey
