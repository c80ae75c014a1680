// The range filter by its words: what it starts from, what it refuses, what it forgets.
#include "fusion/estimators/range_ekf.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>

namespace locus {
namespace {

Site hall() {
    Site site;
    const Vec3 corners[]{{-4, -4, 0.2}, {-4, 4, 3},   {4, 4, 0.2}, {4, -4, 3},
                         {-4, -4, 3},   {4, -4, 0.2}, {4, 4, 3},   {-4, 4, 0.2}};
    for (const Vec3& corner : corners) site.anchors.push_back({"", address(site.anchors.size()), corner});
    return site;
}

double distance_m(const Site& site, std::size_t anchor, const Vec3& p) {
    const Vec3& a = site.anchors[anchor].position_site_m;
    return std::hypot(p[0] - a[0], p[1] - a[1], p[2] - a[2]);
}

Measurement range_at(const Site& site, std::size_t anchor, const Vec3& p, double time_s, double error_m = 0) {
    return {timestamp_from_s(time_s), 0, 0,
            Range{site.anchors[anchor].address, address(9), distance_m(site, anchor, p) + error_m}};
}

Measurement difference_at(const Site& site, std::size_t a, std::size_t b, const Vec3& p, double time_s,
                          double error_m = 0) {
    return {timestamp_from_s(time_s), 0, 0,
            RangeDifference{site.anchors[a].address, site.anchors[b].address, address(9),
                            distance_m(site, b, p) - distance_m(site, a, p) + error_m}};
}

double error_m(const Estimate& estimate, const Vec3& p) {
    const Vec3& x = estimate.position_site_m;
    return std::hypot(x[0] - p[0], x[1] - p[1], x[2] - p[2]);
}

constexpr Vec3 here{1, -1, 1.2};

/// A round of ranges to all anchors every 0.1 s, until `to_s`.
void hear_ranges(RangeEkf& filter, const Site& site, const Vec3& p, double from_s, double to_s, double error_m = 0) {
    int round = 0;
    for (double t = from_s; t < to_s; t = from_s + 0.0125 * ++round)
        filter.update(range_at(site, round % 8, p, t, error_m));
}

TEST(RangeEkf, SaysWhatIsMissingUntilItHasAPosition) {
    const Site site = hall();
    RangeEkf filter(site, {});
    EXPECT_EQ(filter.predict(timestamp_from_s(1)).missing, Missing::measurements);
    EXPECT_EQ(filter.update(range_at(site, 0, here, 1)).reason, Exclusion::geometry_too_few);
    EXPECT_EQ(filter.predict(timestamp_from_s(1)).missing, Missing::anchors);
    hear_ranges(filter, site, here, 1.1, 1.3);
    const Estimate estimate = filter.predict(timestamp_from_s(1.3));
    EXPECT_EQ(estimate.missing, Missing::nothing);
    EXPECT_LT(error_m(estimate, here), 0.01);
    EXPECT_EQ(estimate.kinds_used, 1u);
    EXPECT_EQ(estimate.reset_count, 0u);
}

TEST(RangeEkf, StartsFromDifferencesAsWell) {
    const Site site = hall();
    RangeEkf filter(site, {});
    for (int i = 0; i < 24; ++i) filter.update(difference_at(site, i % 8, (i + 1) % 8, here, 1 + 0.01 * i));
    const Estimate estimate = filter.predict(timestamp_from_s(1.3));
    EXPECT_EQ(estimate.missing, Missing::nothing);
    EXPECT_LT(error_m(estimate, here), 0.01);
    EXPECT_EQ(estimate.kinds_used, 2u);
}

TEST(RangeEkf, RefusesWithTheReason) {
    const Site site = hall();
    RangeEkf filter(site, {});
    hear_ranges(filter, site, here, 1, 2);
    const auto reason = [&](const Observation& o) { return filter.update({timestamp_from_s(2), 0, 0, o}).reason; };
    EXPECT_EQ(reason(Range{address(77), address(9), 3}), Exclusion::unknown_source);
    EXPECT_EQ(reason(Range{address(1), address(9), std::nan("")}), Exclusion::not_finite);
    EXPECT_EQ(reason(Range{address(1), address(9), 1e5}), Exclusion::out_of_reach);
    EXPECT_EQ(reason(RangeDifference{address(1), address(1), address(9), 0}), Exclusion::unknown_source);
    EXPECT_EQ(reason(Range{address(1), address(9), 5, 0.1f, unknown_f, unknown_f, LineOfSight::blocked}),
              Exclusion::reported_blocked);
    EXPECT_EQ(reason(Pressure{address(9), 101325}), Exclusion::unsupported_kind);
    const Verdict far = filter.update(range_at(site, 1, here, 2, 5));
    EXPECT_EQ(far.reason, Exclusion::innovation_too_large);
    EXPECT_GT(far.test_ratio, 1);
    EXPECT_NEAR(far.innovation, 5, 0.2);
    EXPECT_LT(error_m(filter.predict(timestamp_from_s(2)), here), 0.01);
}

TEST(RangeEkf, CalibratedBiasOfAnAnchorIsTakenOff) {
    Site site = hall();
    site.anchors[2].range_bias_m = 1.5;
    RangeEkf filter(site, {});
    Site unbiased = hall();
    for (int i = 0; i < 80; ++i) filter.update(range_at(unbiased, i % 8, here, 1 + 0.01 * i, i % 8 == 2 ? 1.5 : 0));
    EXPECT_LT(error_m(filter.predict(timestamp_from_s(1.8)), here), 0.01);
}

TEST(RangeEkf, FindsTheErrorThatAllRangesHaveInCommon) {
    const Site site = hall();
    RangeEkf filter(site, {});
    const Vec3 off_centre{2.5, -2, 0.8};
    hear_ranges(filter, site, off_centre, 1, 6, -0.3);
    EXPECT_LT(error_m(filter.predict(timestamp_from_s(6)), off_centre), 0.05);
}

TEST(RangeEkf, MovesToWhereTheTargetPlainlyIsAndSaysSo) {
    const Site site = hall();
    RangeEkf filter(site, {});
    hear_ranges(filter, site, here, 1, 3);
    const Vec3 elsewhere{-3, 2, 1};
    hear_ranges(filter, site, elsewhere, 3, 5);
    const Estimate estimate = filter.predict(timestamp_from_s(5));
    EXPECT_EQ(estimate.reset_count, 1u);
    EXPECT_LT(error_m(estimate, elsewhere), 0.05);
}

TEST(RangeEkf, OneLyingAnchorDoesNotMoveIt) {
    const Site site = hall();
    RangeEkf filter(site, {});
    hear_ranges(filter, site, here, 1, 3);
    for (int i = 0; i < 800; ++i) filter.update(range_at(site, i % 8, here, 3 + 0.0125 * i, i % 8 == 3 ? 4 : 0));
    const Estimate estimate = filter.predict(timestamp_from_s(13));
    EXPECT_EQ(estimate.reset_count, 0u);
    EXPECT_LT(error_m(estimate, here), 0.1);
}

TEST(RangeEkf, StartsAnewAfterALongSilence) {
    const Site site = hall();
    RangeEkf filter(site, {});
    hear_ranges(filter, site, here, 1, 3);
    EXPECT_EQ(filter.update(range_at(site, 0, here, 30)).reason, Exclusion::waiting_for_start);
    const Vec3 elsewhere{-3, 2, 1};
    hear_ranges(filter, site, elsewhere, 30.1, 31);
    const Estimate estimate = filter.predict(timestamp_from_s(31));
    EXPECT_LT(error_m(estimate, elsewhere), 0.05);
    EXPECT_EQ(estimate.reset_count, 1u);
}

TEST(RangeEkf, PlanarKeepsTheStatedHeight) {
    const Site site = hall();
    RangeEkfSettings settings;
    settings.planar = true;
    settings.height_m = here[2];
    RangeEkf filter(site, settings);
    hear_ranges(filter, site, here, 1, 3);
    const Estimate estimate = filter.predict(timestamp_from_s(3.5));
    EXPECT_LT(error_m(estimate, here), 0.01);
    EXPECT_EQ(estimate.position_site_m[2], here[2]);
    EXPECT_EQ(estimate.covariance[2 * 6 + 2], 0);
}

TEST(RangeEkf, PredictChangesNothingAndACopyGivesTheSameBits) {
    const Site site = hall();
    RangeEkf filter(site, {});
    hear_ranges(filter, site, here, 1, 2);
    const auto copy = filter.clone();
    RangeEkf other(site, {});
    other.copy_from(filter);
    filter.predict(timestamp_from_s(9));
    for (RangeEkf* f : {&filter, &other, static_cast<RangeEkf*>(copy.get())}) hear_ranges(*f, site, here, 2, 3, 0.07);
    const Estimate a = filter.predict(timestamp_from_s(3)), b = other.predict(timestamp_from_s(3)),
                   c = copy->predict(timestamp_from_s(3));
    EXPECT_EQ(a.position_site_m, b.position_site_m);
    EXPECT_EQ(a.covariance, b.covariance);
    EXPECT_EQ(a.position_site_m, c.position_site_m);
    EXPECT_EQ(a.covariance, c.covariance);
}

TEST(RangeEkf, TheTableOffersItWithItsDefaults) {
    const EstimatorRow* row = find_estimator("range_ekf");
    ASSERT_NE(row, nullptr);
    const auto settings = row->options.make();
    for (const OptionRow& option : row->options.rows) {
        const OptionValue value = option.get(settings.get());
        if (const double* number = std::get_if<double>(&value)) {
            EXPECT_GE(*number, option.minimum) << option.name;
            EXPECT_LE(*number, option.maximum) << option.name;
        }
    }
    const Site site = hall();
    EXPECT_EQ(row->make(site, settings.get())->predict(timestamp_from_s(1)).missing, Missing::measurements);
}

} // namespace
} // namespace locus
