#include "fusion/radio/reading_noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace locus::radio {
namespace {

constexpr ReadingNoise without_floor{0.2F, 8, 0};

double sum_of(const ReadingNoise& noise, float sigma_db) {
    double sum = 0;
    constexpr int steps = 4000;
    for (int i = 0; i < steps; ++i) {
        const float off_db = -120.0F + 160.0F * (static_cast<float>(i) + 0.5F) / steps;
        sum += 160.0 / steps * std::exp(double{log_likelihood(off_db, sigma_db * sigma_db, noise)});
    }
    return sum;
}

TEST(ReadingNoise, IsADensity) {
    for (const float sigma_db : {1.0F, 3.0F, 6.0F}) EXPECT_NEAR(sum_of(without_floor, sigma_db), 1, 0.02) << sigma_db;
    EXPECT_NEAR(sum_of(without_floor, 11), 1, 0.1);
}

TEST(ReadingNoise, ABodyMakesWeakerAndNeverStronger) {
    const float weaker = log_likelihood(-15, 9, {}), stronger = log_likelihood(15, 9, {}),
                none = log_likelihood(-15, 9, {0, 8, 0.05F});
    EXPECT_GT(weaker, stronger + 1);
    EXPECT_GT(weaker, none + 1);
    EXPECT_NEAR(stronger, log_likelihood(15, 9, {0, 8, 0.05F}), 0.05);
}

TEST(ReadingNoise, WhatFitsNothingIsAsLikelyAnywhere) {
    const float floor = std::log(0.05F / outlier_range_db);
    EXPECT_NEAR(log_likelihood(60, 9, {}), floor, 1e-3);
    EXPECT_NEAR(log_likelihood(1000, 9, {}), floor, 1e-3);
    EXPECT_TRUE(std::isfinite(log_likelihood(-1e6F, 1, {})));
}

/// Against the normal integral that the logistic curve stands for.
TEST(ReadingNoise, ItsTailIsTheMirroredExponentiallyModifiedNormal) {
    for (const float off_db : {-30.0F, -10.0F, -3.0F, 0.0F, 3.0F}) {
        constexpr double sigma = 3, loss = 8, ratio = sigma / loss;
        const double exact = std::exp(off_db / loss + 0.5 * ratio * ratio) / loss * 0.5 *
                             std::erfc((off_db / sigma + ratio) / std::sqrt(2.0));
        EXPECT_NEAR(shadowed_density(off_db, 3, 8), exact, 0.01 * std::max(exact, 0.15)) << off_db;
    }
}

} // namespace
} // namespace locus::radio
