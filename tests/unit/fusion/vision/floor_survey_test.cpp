// Views of the floor from surveyed places: the derivatives, what comes out, and what is refused.
#include "fusion/vision/survey/floor_survey.h"

#include "fusion/vision/survey/floor_start.h"
#include "tests/unit/fusion/vision/cameras.h"

#include <gtest/gtest.h>

#include <random>

namespace locus::vision::survey {
namespace {

using vision_test::looking_down;

const std::vector<Eigen::Vector2d> places_m{{-3, 6}, {3, 6}, {4, 14}, {-4, 13}, {0, 9}, {1, 5}};

std::vector<FloorPair> seen(const FloorView& view, double sigma_px = 1) {
    std::vector<FloorPair> pairs;
    for (const auto& place : places_m)
        if (const auto pixel = pixel_of_floor(view, place)) pairs.push_back({*pixel, place, sigma_px, 0.01});
    return pairs;
}

/// The view's homography near its middle, as if it had no distortion.
FloorHomography homography_of(const FloorView& camera) {
    return std::get<FloorHomography>(*start_view(seen(camera), std::nullopt));
}

void expect_derivatives(const FloorView& view, const Eigen::Vector2d& place_m) {
    const Eigen::Vector2d centre_m(0.5, 9);
    const auto sight = sight_of(view, place_m, centre_m);
    ASSERT_TRUE(sight);
    const double h = 1e-6;
    for (int axis = 0; axis < 2; ++axis) {
        const Eigen::Vector2d by_m = h * Eigen::Vector2d::Unit(axis);
        const Eigen::Vector2d slope =
            (sight_of(view, place_m + by_m, centre_m)->pixel_px - sight_of(view, place_m - by_m, centre_m)->pixel_px) /
            (2 * h);
        EXPECT_LT((slope - sight->by_floor.col(axis)).norm(), 1e-5 * (1 + slope.norm()));
    }
    for (int i = 0; i < view_parameters(view); ++i) {
        ViewStep step = ViewStep::Zero(view_parameters(view));
        step[i] = h;
        const Eigen::Vector2d slope = (sight_of(moved(view, step, centre_m), place_m, centre_m)->pixel_px -
                                       sight_of(moved(view, -step, centre_m), place_m, centre_m)->pixel_px) /
                                      (2 * h);
        EXPECT_LT((slope - sight->by_view.col(i)).norm(), 1e-5 * (1 + slope.norm())) << "parameter " << i;
    }
}

TEST(FloorSight, DerivativesAreTheNumericalOnes) {
    for (const Lens& lens : vision_test::lenses()) expect_derivatives(looking_down(lens), {0.3, 8});
    expect_derivatives(homography_of(looking_down(vision_test::plain_pinhole())), {-1, 7});
}

TEST(FloorSurvey, ExactPointsGiveTheCameraBack) {
    for (const Lens& lens : vision_test::lenses()) {
        const Camera truth = looking_down(lens);
        const FloorSurvey survey = survey_floor(seen(truth), lens);
        ASSERT_EQ(survey.trouble, FloorTrouble::none);
        const auto& camera = std::get<Camera>(survey.fit.view);
        EXPECT_LT((camera.position_site_m() - truth.position_site_m()).norm(), 1e-6);
        EXPECT_LT((camera.camera_from_site - truth.camera_from_site).norm(), 1e-7);
        EXPECT_LT(survey.fit.residuals[2].floor_m, 1e-6);
        EXPECT_EQ(survey.widening, 1);
    }
}

TEST(FloorSurvey, FourPointsWithoutALensAreAnExactHomography) {
    const Camera truth = looking_down(vision_test::plain_pinhole());
    auto pairs = seen(truth);
    pairs.resize(4);
    const FloorSurvey survey = survey_floor(pairs, std::nullopt);
    ASSERT_EQ(survey.trouble, FloorTrouble::none);
    EXPECT_EQ(survey.redundancy, 0);
    const auto there = foot_on_floor(survey.fit.view, {*pixel_of_floor(truth, {0.5, 8}), Eigen::Matrix2d::Identity()});
    ASSERT_TRUE(there);
    EXPECT_LT((there->position_site_m - Eigen::Vector2d(0.5, 8)).norm(), 1e-6);
}

/// Normalised squared error of the camera's position over many surveys: as many as there are coordinates.
TEST(FloorSurvey, ItIsAsSureAsItSays) {
    const Lens lens = vision_test::lenses()[1];
    const Camera truth = looking_down(lens);
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    double sum = 0;
    constexpr int surveys = 200;
    for (int i = 0; i < surveys; ++i) {
        auto pairs = seen(truth, 2);
        for (FloorPair& pair : pairs) {
            pair.pixel_px += 2 * Eigen::Vector2d(normal(random), normal(random));
            pair.site_m += 0.01 * Eigen::Vector2d(normal(random), normal(random));
        }
        FloorSurvey survey = survey_floor(pairs, lens);
        ASSERT_EQ(survey.trouble, FloorTrouble::none);
        survey.fit.covariance /= survey.widening * survey.widening;
        const Eigen::Vector3d sigma_m = position_sigma_m(survey.fit);
        const Eigen::Vector3d error_m = std::get<Camera>(survey.fit.view).position_site_m() - truth.position_site_m();
        sum += error_m.cwiseQuotient(sigma_m).squaredNorm() / surveys;
    }
    EXPECT_NEAR(sum, 3, 0.7); // three standard errors of a mean of 200, were the three independent: 0.52
}

TEST(FloorSurvey, AWrongPointIsNamed) {
    const Lens lens = vision_test::plain_pinhole();
    auto pairs = seen(looking_down(lens));
    pairs[3].site_m.x() += 1; // written down wrongly
    for (const auto& known : {std::optional<Lens>(lens), std::optional<Lens>()}) {
        const FloorSurvey survey = survey_floor(pairs, known);
        EXPECT_EQ(survey.worst, 3u);
        EXPECT_TRUE(survey.is_worst_told);
        EXPECT_GT(survey.widening, 2);
    }
}

TEST(FloorSurvey, WhatCannotWorkIsRefused) {
    const Lens lens = vision_test::plain_pinhole();
    auto pairs = seen(looking_down(lens));
    EXPECT_EQ(survey_floor({pairs.data(), 3}, lens).trouble, FloorTrouble::too_few);
    auto line = pairs;
    for (std::size_t i = 0; i < line.size(); ++i) {
        line[i].site_m = {0.1 * static_cast<double>(i), 5 + static_cast<double>(i)};
        line[i].pixel_px = *pixel_of_floor(looking_down(lens), line[i].site_m);
    }
    EXPECT_EQ(survey_floor(line, lens).trouble, FloorTrouble::in_one_line);
    EXPECT_EQ(survey_floor(line, std::nullopt).trouble, FloorTrouble::in_one_line);
    auto swapped = pairs;
    for (FloorPair& pair : swapped) std::swap(pair.site_m.x(), pair.site_m.y());
    EXPECT_EQ(survey_floor(swapped, lens).trouble, FloorTrouble::mirrored);
    EXPECT_EQ(survey_floor(swapped, std::nullopt).trouble, FloorTrouble::mirrored);
    std::vector<FloorPair> three_in_line(pairs.begin(), pairs.begin() + 4);
    three_in_line[2].site_m = 0.5 * (three_in_line[0].site_m + three_in_line[1].site_m);
    three_in_line[2].pixel_px = *pixel_of_floor(looking_down(lens), three_in_line[2].site_m);
    EXPECT_EQ(survey_floor(three_in_line, std::nullopt).trouble, FloorTrouble::not_told);
}

} // namespace
} // namespace locus::vision::survey
