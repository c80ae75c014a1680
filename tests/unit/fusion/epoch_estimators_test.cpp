// The estimators behind Chan-Taylor, all by the same words: how they start, what an epoch is, that copies are copies.
#include "fusion/estimators/chan_taylor.h"
#include "fusion/estimators/kalman.h"
#include "tests/allocations.h"
#include "tests/unit/fusion/simulated_tag.h"

#include <gtest/gtest.h>

#include <cmath>

namespace locus::epoch_test {
namespace {

constexpr Vec3 here{1, -1, 1.2};

double distance_m(const Site& site, std::size_t anchor, const Vec3& p) {
    return (vector(site.anchors[anchor].position_site_m) - vector(p)).norm();
}

Measurement range_to(const Site& site, std::size_t anchor, const Vec3& p, double time_s, double error_m = 0) {
    return {timestamp_from_s(time_s), 0, 0,
            Range{site.anchors[anchor].address, address(9), distance_m(site, anchor, p) + error_m}};
}

Measurement difference_between(const Site& site, std::size_t a, std::size_t b, const Vec3& p, double time_s) {
    return {timestamp_from_s(time_s), 0, 0,
            RangeDifference{site.anchors[a].address, site.anchors[b].address, address(9),
                            distance_m(site, b, p) - distance_m(site, a, p)}};
}

double error_m(const Estimate& estimate, const Vec3& p) {
    return (vector(estimate.position_site_m) - vector(p)).norm();
}

/// Sweeps over all eight anchors, ten a second, of a tag that walks along x at `speed_mps`.
void sweep(Estimator& estimator, const Site& site, double from_s, double to_s, double speed_mps = 0) {
    for (double t = from_s; t < to_s; t += 0.1)
        for (std::size_t i = 0; i < 8; ++i)
            estimator.update(range_to(site, i, {here[0] + speed_mps * (t - from_s), here[1], here[2]}, t));
}

class EpochEstimators : public testing::TestWithParam<const char*> {
  protected:
    std::unique_ptr<Estimator> make(const Site& site) const {
        const EstimatorRow* row = find_estimator(GetParam());
        return row->make(site, row->options.make().get());
    }
};

TEST_P(EpochEstimators, SaysWhatIsMissingUntilAnEpochHasAPosition) {
    const Site site = test::hall();
    const auto estimator = make(site);
    EXPECT_EQ(estimator->predict(timestamp_from_s(1)).missing, Missing::measurements);
    EXPECT_EQ(estimator->update(range_to(site, 0, here, 1)).reason, Exclusion::geometry_too_few);
    EXPECT_EQ(estimator->predict(timestamp_from_s(1)).missing, Missing::anchors);
    sweep(*estimator, site, 1.2, 1.25);
    const Estimate estimate = estimator->predict(timestamp_from_s(1.2));
    EXPECT_EQ(estimate.missing, Missing::nothing);
    EXPECT_LT(error_m(estimate, here), 1e-3);
    EXPECT_EQ(estimate.kinds_used, 1u);
    EXPECT_EQ(estimate.time, timestamp_from_s(1.2));
}

TEST_P(EpochEstimators, TakeDifferencesAsWell) {
    const Site site = test::hall();
    const auto estimator = make(site);
    for (std::size_t i = 0; i < 80; ++i)
        estimator->update(difference_between(site, i % 8, (i + 1) % 8, here, 1 + 0.01 * static_cast<double>(i)));
    const Estimate estimate = estimator->predict(timestamp_from_s(1.8));
    EXPECT_LT(error_m(estimate, here), 1e-3);
    EXPECT_EQ(estimate.kinds_used, 2u);
}

TEST_P(EpochEstimators, LeaveOutTheAnchorThatLies) {
    const Site site = test::hall();
    const auto estimator = make(site);
    for (double t = 1; t < 3; t += 0.1)
        for (std::size_t i = 0; i < 8; ++i) estimator->update(range_to(site, i, here, t, i == 3 ? 4 : 0));
    EXPECT_LT(error_m(estimator->predict(timestamp_from_s(3)), here), 0.02);
}

TEST_P(EpochEstimators, RefuseWithTheReason) {
    const Site site = test::hall();
    const auto estimator = make(site);
    sweep(*estimator, site, 1, 2);
    const auto reason = [&](const Observation& o) { return estimator->update({timestamp_from_s(2), 0, 0, o}).reason; };
    EXPECT_EQ(reason(Range{address(77), address(9), 3}), Exclusion::unknown_source);
    EXPECT_EQ(reason(Range{address(1), address(9), std::nan("")}), Exclusion::not_finite);
    EXPECT_EQ(reason(Pressure{address(9), 101325}), Exclusion::unsupported_kind);
    for (double t = 2.5; t < 4; t += 0.1) estimator->update(range_to(site, 0, here, t));
    EXPECT_EQ(estimator->update(range_to(site, 1, here, 4)).reason, Exclusion::geometry_too_few)
        << "one anchor at a time is no epoch";
}

TEST_P(EpochEstimators, TheBoundGrowsWithTheAgeOfThePosition) {
    const Site site = test::hall();
    const auto estimator = make(site);
    sweep(*estimator, site, 1, 3);
    double last = 0;
    for (const double t : {3.0, 3.2, 4.0}) {
        const Estimate estimate = estimator->predict(timestamp_from_s(t));
        EXPECT_GT(estimate.covariance[0], last) << t;
        EXPECT_EQ(estimate.covariance[3], estimate.covariance[18]) << "symmetric";
        last = estimate.covariance[0];
    }
}

TEST_P(EpochEstimators, PredictChangesNothingAndACopyGivesTheSameBits) {
    const Site site = test::hall();
    const auto estimator = make(site), other = make(site);
    sweep(*estimator, site, 1, 3, 0.5);
    const auto clone = estimator->clone();
    other->copy_from(*estimator);
    estimator->predict(timestamp_from_s(9));
    for (Estimator* e : {estimator.get(), clone.get(), other.get()}) sweep(*e, site, 3, 4, 0.7);
    const Estimate a = estimator->predict(timestamp_from_s(4));
    for (const Estimator* e : {clone.get(), other.get()}) {
        const Estimate b = e->predict(timestamp_from_s(4));
        EXPECT_EQ(a.position_site_m, b.position_site_m);
        EXPECT_EQ(a.velocity_site_mps, b.velocity_site_mps);
        EXPECT_EQ(a.covariance, b.covariance);
    }
}

TEST_P(EpochEstimators, AllocateNothing) {
    const Site site = test::hall();
    const auto estimator = make(site), other = make(site);
    const test::AllocationCount count;
    for (int i = 0; i < 30; ++i) {
        sweep(*estimator, site, 1 + i, 2 + i, 0.5);
        other->copy_from(*estimator);
        EXPECT_EQ(other->predict(timestamp_from_s(2.0 + i)).missing, Missing::nothing);
    }
    EXPECT_EQ(count.made(), 0u);
}

INSTANTIATE_TEST_SUITE_P(All, EpochEstimators,
                         testing::Values("chan_taylor", "kalman", "coloured_kalman", "pca_kalman"),
                         [](const auto& name) { return std::string(name.param); });

TEST(EpochEstimator, PlanarKeepsTheStatedHeight) {
    const Site site = test::hall();
    PcaKalmanSettings settings;
    settings.planar = true;
    settings.height_m = here[2];
    EpochEstimator<PcaKalman> estimator(site, settings);
    sweep(estimator, site, 1, 3);
    const Estimate estimate = estimator.predict(timestamp_from_s(3.5));
    EXPECT_LT(error_m(estimate, here), 1e-3);
    EXPECT_EQ(estimate.position_site_m[2], here[2]);
    for (const int i : {2, 5}) EXPECT_EQ(estimate.covariance[static_cast<std::size_t>(7 * i)], 0);
}

TEST(EpochEstimator, FiltersFindTheVelocity) {
    const Site site = test::hall();
    EpochEstimator<FixKalman<KalmanSettings>> filter(site, {});
    sweep(filter, site, 1, 5, 0.5);
    EXPECT_NEAR(filter.predict(timestamp_from_s(5)).velocity_site_mps[0], 0.5, 0.01);
    EpochEstimator<LastFix> fixes(site, {});
    sweep(fixes, site, 1, 5, 0.5);
    EXPECT_EQ(fixes.predict(timestamp_from_s(5)).velocity_site_mps[0], 0) << "one position tells no velocity";
    EXPECT_GE(fixes.predict(timestamp_from_s(5)).covariance[21], 1);
}

// Eight ranges heard at one moment are one position of eight ranges, however many were made on the way.
TEST(EpochEstimator, NoMeasurementIsTakenTwice) {
    const Site site = test::hall();
    EpochEstimator<FixKalman<KalmanSettings>> filter(site, {});
    const auto variance_after = [&](double from_s, double to_s) {
        sweep(filter, site, from_s, to_s);
        return filter.predict(timestamp_from_s(from_s)).covariance[0];
    };
    uwb::EpochSettings settings;
    settings.held_range_sigma_m = KalmanSettings{}.anchor_error_sigma_m;
    uwb::EpochKeeper keeper(site, settings);
    for (std::int16_t i = 0; i < 8; ++i)
        keeper.keep({i, uwb::Sighting::nobody, 0.1f, distance_m(site, static_cast<std::size_t>(i), here)},
                    timestamp_from_s(1));
    const double of_one_fix = keeper.solve(timestamp_from_s(1), {}).fix.covariance_m2[0];
    EXPECT_NEAR(variance_after(1, 1.05), of_one_fix, 1e-6 * of_one_fix);
}

TEST(EpochGatherer, ASweepIsAnEpochAndSoIsItsTime) {
    const Site site = test::hall();
    EpochGatherer gatherer(site, {}, EpochGatherer::Reach::epoch);
    std::vector<std::size_t> opened;
    for (std::size_t i = 0; i < 24; ++i) {
        const double t = 1 + 0.1 * static_cast<double>(i / 8);
        if (gatherer.take(range_to(site, i % 8, here, t)).opens_epoch) opened.push_back(i);
    }
    EXPECT_EQ(opened, (std::vector<std::size_t>{0, 8, 16}));
    EXPECT_FALSE(gatherer.take(range_to(site, 0, here, 1.21)).fix) << "a new epoch, and one range is too few";
    EXPECT_TRUE(gatherer.take(range_to(site, 1, here, 1.42)).opens_epoch) << "its time was over";
}

TEST(EpochGatherer, AnAnchorThatIsHeardTwiceBeforeThereIsAPositionOpensNoEpoch) {
    const Site site = test::hall();
    EpochGatherer gatherer(site, {}, EpochGatherer::Reach::epoch);
    EXPECT_TRUE(gatherer.take(range_to(site, 0, here, 1)).opens_epoch);
    for (const std::size_t anchor : {0, 1, 0, 2})
        EXPECT_FALSE(gatherer.take(range_to(site, anchor, here, 1)).opens_epoch);
    EXPECT_TRUE(gatherer.take(range_to(site, 4, here, 1)).fix);
}

} // namespace
} // namespace locus::epoch_test
