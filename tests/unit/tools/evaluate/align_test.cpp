// Association and alignment: known transformations come back, and what cannot be known is refused.
#include "tools/evaluate/align.h"
#include "tools/evaluate/associate.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <Eigen/Geometry>

#include <random>
#include <stdexcept>

namespace locus::evaluate {
namespace {

TrackPoint at(double time_s, double x, double z = 0) { return {time_s, {x, 0, z}}; }

TEST(Associate, InterpolatesTheTruthAtEachEstimate) {
    const Track truth{at(0, 0), at(0.1, 1), at(0.2, 3)};
    const auto result = associate(truth, {at(0, 7), at(0.05, 7), at(0.125, 7), at(0.2, 7)}, {});
    ASSERT_EQ(result.pairs.size(), 4u);
    EXPECT_DOUBLE_EQ(result.pairs[0].truth_m.x(), 0);
    EXPECT_DOUBLE_EQ(result.pairs[1].truth_m.x(), 0.5);
    EXPECT_DOUBLE_EQ(result.pairs[2].truth_m.x(), 1.5);
    EXPECT_DOUBLE_EQ(result.pairs[3].truth_m.x(), 3);
    EXPECT_EQ(result.pairs[1].estimate_m.x(), 7);
}

TEST(Associate, CountsWhatItLeavesOut) {
    const Track truth{at(1, 0), at(1.1, 0), at(2, 0), at(2.1, 0, 5)};
    const Track estimate{at(0.9, 0), at(1, 0), at(1.5, 0), at(2, 0), at(2.1, 0), at(2.2, 0)};
    const auto result = associate(truth, estimate, {.max_gap_s = 0.25, .from_s = 1.05, .min_truth_z_m = 1});
    EXPECT_EQ(result.outside_truth, 2u);
    EXPECT_EQ(result.in_gap, 1u);
    EXPECT_EQ(result.not_selected, 2u);
    ASSERT_EQ(result.pairs.size(), 1u);
    EXPECT_EQ(result.pairs[0].time_s, 2.1);
}

TEST(Associate, NeverLosesAPoseUncounted) {
    EXPECT_TRUE(rc::check([](const std::vector<unsigned>& truth_steps, const std::vector<unsigned>& steps) {
        const auto track = [](const std::vector<unsigned>& from) {
            Track result;
            double time_s = 0;
            for (const unsigned step : from) result.push_back(at(time_s += 0.01 * (1 + step % 50), 0));
            return result;
        };
        const Track estimate = track(steps);
        const auto result = associate(track(truth_steps), estimate, {.from_s = 1});
        RC_ASSERT(result.pairs.size() + result.outside_truth + result.in_gap + result.not_selected == estimate.size());
    }));
}

struct Scene {
    std::vector<Pair> pairs;
    Similarity similarity;
};

// Truth = similarity of the estimate, plus noise.
Scene scene(unsigned seed, Alignment alignment, double noise_m) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const auto vector = [&] { return Eigen::Vector3d(normal(random), normal(random), normal(random)); };
    Scene result;
    const Eigen::Vector3d axis = alignment == Alignment::yaw ? Eigen::Vector3d::UnitZ() : vector().normalized();
    result.similarity.rotation = Eigen::AngleAxisd(2 * normal(random), axis).toRotationMatrix();
    result.similarity.translation_m = 10 * vector();
    if (alignment == Alignment::sim3) result.similarity.scale = std::exp(normal(random));
    for (int i = 0; i < 40; ++i) {
        const Eigen::Vector3d estimate_m = 5 * vector();
        result.pairs.push_back({0.1 * i, result.similarity(estimate_m) + noise_m * vector(), estimate_m});
    }
    return result;
}

double squares(const std::vector<Pair>& pairs, const Similarity& similarity) {
    double sum = 0;
    for (const auto& pair : pairs) sum += (similarity(pair.estimate_m) - pair.truth_m).squaredNorm();
    return sum;
}

class AlignBy : public testing::TestWithParam<Alignment> {};

TEST_P(AlignBy, KnownTransformationsComeBack) {
    EXPECT_TRUE(rc::check([](unsigned seed) {
        const auto [pairs, known] = scene(seed, GetParam(), 0);
        const Similarity found = align(pairs, GetParam());
        RC_ASSERT(std::abs(found.scale - known.scale) < 1e-9);
        RC_ASSERT((found.rotation - known.rotation).norm() < 1e-9);
        RC_ASSERT((found.translation_m - known.translation_m).norm() < 1e-9);
    }));
}

TEST_P(AlignBy, NoNeighbourFitsBetter) {
    EXPECT_TRUE(rc::check([](unsigned seed) {
        const auto pairs = scene(seed, GetParam(), 0.3).pairs;
        const Similarity best = align(pairs, GetParam());
        RC_ASSERT(std::abs(best.rotation.determinant() - 1) < 1e-9);
        for (const double step : {-1e-3, 1e-3})
            for (int axis = 0; axis < 3; ++axis) {
                Similarity moved = best, turned = best, scaled = best;
                moved.translation_m[axis] += step;
                RC_ASSERT(squares(pairs, moved) > squares(pairs, best));
                if (GetParam() == Alignment::yaw && axis < 2) continue;
                turned.rotation = Eigen::AngleAxisd(step, Eigen::Vector3d::Unit(axis)) * best.rotation;
                scaled.scale *= 1 + step;
                RC_ASSERT(squares(pairs, turned) > squares(pairs, best));
                if (GetParam() == Alignment::sim3) RC_ASSERT(squares(pairs, scaled) > squares(pairs, best));
            }
    }));
}

INSTANTIATE_TEST_SUITE_P(Each, AlignBy, testing::Values(Alignment::yaw, Alignment::se3, Alignment::sim3));

TEST(Align, NoneLeavesAllAsItIs) {
    const Similarity same = align(scene(1, Alignment::se3, 1).pairs, Alignment::none);
    EXPECT_EQ(same({1, 2, 3}), Eigen::Vector3d(1, 2, 3));
}

TEST(Align, AMirroredTrackIsTurnedNotMirrored) {
    auto pairs = scene(2, Alignment::se3, 0).pairs;
    for (auto& pair : pairs) pair.truth_m.x() = -pair.truth_m.x();
    EXPECT_NEAR(align(pairs, Alignment::se3).rotation.determinant(), 1, 1e-9);
}

TEST(Align, AFlatTrackFixesTheTurn) {
    auto [pairs, known] = scene(3, Alignment::se3, 0);
    for (auto& pair : pairs) {
        pair.estimate_m.z() = 1;
        pair.truth_m = known(pair.estimate_m);
    }
    EXPECT_LT((align(pairs, Alignment::se3).rotation - known.rotation).norm(), 1e-9);
}

TEST(Align, RefusesWhatDoesNotFixTheTransformation) {
    std::vector<Pair> line, point;
    for (int i = 0; i < 10; ++i) {
        const Eigen::Vector3d p(1e3 + i, 2. * i, 3. * i);
        line.push_back({0.1 * i, p, p});
        point.push_back({0.1 * i, {1e3, 2, 0.1 * i}, {7, 8, 0.1 * i}});
    }
    EXPECT_THROW(align(line, Alignment::se3), std::invalid_argument);
    EXPECT_THROW(align(line, Alignment::sim3), std::invalid_argument);
    EXPECT_NO_THROW(align(line, Alignment::yaw));
    EXPECT_THROW(align(point, Alignment::yaw), std::invalid_argument);
    EXPECT_THROW(align(std::span(line).first(1), Alignment::yaw), std::invalid_argument);
}

} // namespace
} // namespace locus::evaluate
