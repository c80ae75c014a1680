// The pieces that give a SLAM's path its scale: the similarity and its Jacobian, the start in closed form, the bounded
// set of ranges, the estimator's memory, and the six states of paper 001.
#include "fusion/estimators/visual_scale.h"
#include "fusion/geometry/rotation.h"
#include "fusion/vision/scale/similarity_start.h"
#include "fusion/vision/scale/six_state.h"
#include "tests/allocations.h"
#include "tests/unit/fusion/jacobian.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace locus::vision {
namespace {

Similarity some_similarity() {
    Similarity similarity;
    similarity.log_scale = 0.7;
    similarity.site_from_odometry = rotation({0.4, -1.2, 2.0});
    similarity.origin_site_m = {3, -2, 1};
    similarity.centre_odometry = {0.1, 0.2, -0.3};
    similarity.offset_s = 0.05;
    return similarity;
}

/// Of someone who walks a bent way, in the odometry's frame.
Eigen::Vector3d bent_way(double time_s) {
    return {std::sin(0.5 * time_s), 1 - std::cos(0.4 * time_s), 0.1 * std::sin(time_s)};
}

TEST(VisualSimilarity, JacobianIsThatOfThePlace) {
    const Similarity similarity = some_similarity();
    const Eigen::Vector3d position(1, 2, -1), velocity(0.3, -0.2, 0.1);
    const auto moved = [&](const Eigen::VectorXd& step) {
        Similarity other = similarity;
        other.move_by(step);
        return Eigen::VectorXd(other.place_site_m(position, velocity));
    };
    EXPECT_TRUE(test::jacobian_matches(moved, similarity.jacobian(position, velocity), Eigen::VectorXd::Zero(8)));
}

TEST(VisualSimilarity, StartIsExactWithoutNoise) {
    Similarity truth = some_similarity();
    truth.offset_s = 0;
    std::vector<KeyPlace> places;
    for (int i = 0; i < 12; ++i)
        places.push_back({bent_way(i), truth.place_site_m(bent_way(i), Eigen::Vector3d::Zero()), 1});
    const auto start = start_of_similarity(places);
    ASSERT_TRUE(start.has_value());
    EXPECT_NEAR(start->log_scale, truth.log_scale, 1e-9);
    EXPECT_NEAR(start->site_from_odometry.angularDistance(truth.site_from_odometry), 0, 1e-7);
    const Eigen::Vector3d elsewhere(5, -3, 2), still = Eigen::Vector3d::Zero();
    EXPECT_LT((start->place_site_m(elsewhere, still) - truth.place_site_m(elsewhere, still)).norm(), 1e-7);
}

TEST(VisualSimilarity, NoStartWithoutAWay) {
    const std::vector<KeyPlace> standing(10);
    EXPECT_FALSE(start_of_similarity(standing).has_value());
}

TEST(RangeRows, AreBoundedAndKeepTheShape) {
    RangeRows rows;
    RangeRow row;
    row.sighting.plus = 0;
    row.information_per_m2 = 1;
    constexpr std::size_t walked = 100;
    double told = 0;
    for (std::size_t i = 0; i < 3 * RangeRows::capacity; ++i) {
        row.position_odometry.x() = static_cast<double>(std::min(i, walked)); // then stands
        rows.add(row, 0.5);
    }
    ASSERT_EQ(rows.all().size(), RangeRows::capacity);
    for (const RangeRow& kept : rows.all()) told += kept.information_per_m2;
    EXPECT_DOUBLE_EQ(told, 3.0 * RangeRows::capacity) << "standing is joined, nothing is lost";
    EXPECT_EQ(rows.all().front().position_odometry.x(), 0);
}

TEST(SixStates, FindScaleAndDeflection) {
    SixState filter({}, {0, 0, 1, 0, 1, 0}, 0.1);
    constexpr double scale = 2, deflection_rad = 0.8;
    for (int i = 0; i <= 400; ++i) {
        const Eigen::Vector2d seen = bent_way(0.1 * i).head<2>();
        const Eigen::Vector2d place_m = scale * (Eigen::Rotation2Dd(deflection_rad) * seen);
        filter.predict(i == 0 ? 0 : 0.1);
        filter.hear(place_m, 0.05);
        filter.see(seen, {0, 0}, 0.05);
    }
    EXPECT_NEAR(filter.state()(SixState::scale_at), scale, 0.05);
    EXPECT_NEAR(filter.state()(SixState::deflection_at), deflection_rad, 0.05);
}

struct Heard {
    std::vector<Measurement> all;
    double scale = 0;
};

/// Ranges without noise and ten poses a second, 20 s; from `lost_s` on of another segment.
Heard exact_walk(const Site& site, double lost_s) {
    const Similarity similarity = some_similarity();
    Heard heard{{}, similarity.scale()};
    for (int i = 0; i < 200; ++i) {
        const double time_s = 0.1 * i;
        const Eigen::Vector3d way = bent_way(time_s), tag_m = similarity.place_site_m(way, Eigen::Vector3d::Zero());
        VisualOdometry odometry;
        odometry.camera = address(1);
        odometry.segment = time_s < lost_s ? 0 : 1;
        odometry.position_odometry = {way.x(), way.y(), way.z()};
        for (const Anchor& anchor : site.anchors)
            heard.all.push_back({timestamp_from_s(time_s), 0, 0,
                                 Range{anchor.address, address(9), (tag_m - vector(anchor.position_site_m)).norm()}});
        heard.all.push_back({timestamp_from_s(time_s), 0, 1, odometry});
    }
    return heard;
}

Site tall_room() {
    Site site;
    for (const Vec3& corner : {Vec3{-6, -8, 3}, Vec3{9, -8, 0}, Vec3{9, 8, 3}, Vec3{-6, 8, 0}, Vec3{1, 0, 4}})
        site.anchors.push_back({"", address(site.anchors.size()), corner});
    return site;
}

TEST(VisualScale, FindsTheScaleAndAllocatesNothing) {
    const Site site = tall_room();
    const Heard heard = exact_walk(site, 1e9);
    VisualScale estimator(site, {}), copy(site, {});
    const test::AllocationCount count;
    for (const Measurement& measurement : heard.all) estimator.update(measurement);
    copy.copy_from(estimator);
    const Estimate estimate = copy.predict(timestamp_from_s(20));
    EXPECT_EQ(count.made(), 0u);
    EXPECT_NEAR(estimate.odometry_scale.metres_per_unit / heard.scale, 1, 0.01);
    EXPECT_NE(estimate.kinds_used >> Observation(VisualOdometry{}).index() & 1u, 0u);
}

TEST(VisualScale, ANewSegmentIsUnknownAgain) {
    const Site site = tall_room();
    const Heard heard = exact_walk(site, 19.5);
    VisualScale estimator(site, {});
    for (const Measurement& measurement : heard.all) {
        estimator.update(measurement);
        if (measurement.time != timestamp_from_s(19)) continue;
        EXPECT_TRUE(std::isfinite(estimator.predict(measurement.time).odometry_scale.metres_per_unit));
    }
    EXPECT_FALSE(std::isfinite(estimator.predict(timestamp_from_s(20)).odometry_scale.metres_per_unit));
}

} // namespace
} // namespace locus::vision
