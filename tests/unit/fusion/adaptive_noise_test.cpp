// Innovation-based adaptive noise: what it learns, and that one wild innovation does not teach it much.
#include "fusion/filter/adaptive_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace locus::filter {
namespace {

double learnt(double true_factor) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    AdaptiveNoise noise;
    for (int i = 0; i < 5000; ++i) noise.learn(std::sqrt(0.5 + true_factor * 2) * normal(random), 0.5, 2);
    return noise.factor();
}

// Clipping at three sigma takes off 3 %; the factor's own error is a tenth.
TEST(AdaptiveNoise, LearnsTheFactorOnTheStatedVariance) {
    for (const double factor : {0.5, 1.0, 4.0, 20.0}) EXPECT_NEAR(learnt(factor) / factor, 1, 0.35) << factor;
}

TEST(AdaptiveNoise, OneWildInnovationTeachesLittle) {
    AdaptiveNoise noise;
    noise.learn(1e6, 0.5, 2);
    EXPECT_LT(noise.factor(), 1.1);
}

} // namespace
} // namespace locus::filter
