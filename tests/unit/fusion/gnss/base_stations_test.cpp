// A base station and a receiver under the same sky, with errors that both have (orbit, ionosphere, troposphere) and
// errors that each has alone: what corrections do to positions, and what a base does that is wrong, incomplete or
// silent.
#include "fusion/gnss/base_stations.h"

#include "fusion/gnss/ephemeris_words.h"
#include "fusion/gnss/receivers.h"
#include "tests/allocations.h"
#include "tests/unit/fusion/gnss/synthetic_sky.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace locus::gnss {
namespace {

using synthetic::start;

constexpr Address station = address(2003);

struct Taken final : Receivers::Output {
    std::vector<GnssFix> fixes;
    std::vector<SatelliteRange> ranges;

    void take(const Measurement& range, const AidBook::Record&) noexcept override {
        ranges.push_back(std::get<SatelliteRange>(range.observation)); // NOLINT(bugprone-exception-escape)
    }
    void judge(const Measurement&, const AidBook::Record&, Exclusion) noexcept override {}
    void tell(const Measurement& fix) noexcept override {
        fixes.push_back(std::get<GnssFix>(fix.observation)); // NOLINT(bugprone-exception-escape)
    }
};

/// Errors of a satellite that all receivers nearby have alike: 1 m of orbit and clock, as the performance standard has
/// it, and four fifths of Klobuchar's delay on top of it, within what half the delay as a standard deviation allows.
struct SharedErrors {
    std::map<std::pair<unsigned, unsigned>, double> orbit_m;
    double ionosphere_share = 0.8;

    explicit SharedErrors(std::mt19937& random) {
        std::normal_distribution<double> metre;
        for (const auto& e : synthetic::satellites()) orbit_m[{e.constellation, e.satellite}] = metre(random);
    }
    double of(const KeplerEphemeris& e, const synthetic::Truth& at, const GpsTime& time) const {
        return orbit_m.at({e.constellation, e.satellite}) +
               ionosphere_share * synthetic::way(e, at, time, 0).ionosphere_m;
    }
};

synthetic::Truth still(const Geodetic& at, const std::array<double, clock_count>& clocks_m) {
    return {ecef_m(at), Eigen::Vector3d::Zero(), clocks_m, 95};
}

class BaseStationsTest : public testing::Test {
  protected:
    std::mt19937 random{11};
    SharedErrors shared{random};
    synthetic::Truth rover = still({48.1, 11.6, 520}, {21e3, 21e3 + 12, 21e3 - 40, 21e3 + 7});
    synthetic::Truth base = still({48.13, 11.68, 540}, {-140e3, -140e3 + 31, -140e3 - 8, -140e3 + 90}); ///< 7 km
    GnssSettings settings;
    double own_noise_m = 0.5; ///< of each receiver: less than the model counts at 45 dBHz, 0.84 m and multipath
    Taken taken;
    std::optional<Receivers> receivers;
    std::vector<Exclusion> said;

    std::vector<GnssRaw> observed(const synthetic::Truth& at, double after_s) {
        std::normal_distribution<double> noise(0, own_noise_m);
        std::vector<GnssRaw> raws;
        for (const auto& e : synthetic::satellites()) {
            if (!synthetic::is_visible(e, at, start + after_s)) continue;
            raws.push_back(synthetic::observe(e, at, start + after_s));
            raws.back().pseudorange_m += shared.of(e, at, start + after_s) + noise(random);
        }
        return raws;
    }
    std::vector<GnssBaseRange> base_ranges(double after_s) {
        std::vector<GnssBaseRange> ranges;
        for (const GnssRaw& raw : observed(base, after_s)) {
            GnssBaseRange range;
            range.base = station;
            range.time_s_in_gps_week = raw.receiver_time_s_in_gps_week;
            range.pseudorange_m = raw.pseudorange_m;
            for (std::size_t i = 0; i < 3; ++i)
                range.antenna_ecef_m[i] = base.position_ecef_m[static_cast<Eigen::Index>(i)];
            range.carrier_to_noise_dbhz = raw.carrier_to_noise_dbhz;
            range.constellation = raw.constellation;
            range.satellite = raw.satellite;
            range.signal = raw.signal;
            ranges.push_back(range);
        }
        return ranges;
    }

    /// Knows all ephemerides.
    Receivers& fresh() {
        receivers.emplace(Site{}, settings, duration_from_s(0.1));
        hear(observed(rover, -100), -100);
        const auto ionosphere = encode(synthetic::ionosphere, 6, start);
        if (ionosphere) receivers->hear(*ionosphere);
        for (const auto& e : synthetic::satellites())
            for (const auto& words : encode(Ephemeris{e}, start, 18)) receivers->hear(words);
        taken = {};
        said.clear();
        return *receivers;
    }
    void hear(const std::vector<GnssRaw>& raws, double after_s) {
        const Timestamp time = timestamp_from_s(1000 + after_s);
        for (const GnssRaw& raw : raws) receivers->hear({time, 0, 0, raw}, {}, time, taken);
        receivers->run(time + std::chrono::seconds{1}, taken);
    }
    void hear(const std::vector<GnssBaseRange>& ranges) {
        said.clear();
        for (const GnssBaseRange& range : ranges) said.push_back(receivers->hear(range, 1));
    }
    double error_m(const GnssFix& fix) const {
        const Eigen::Vector3d at_m = ecef_m({fix.latitude_deg, fix.longitude_deg, fix.height_ellipsoid_m});
        return (at_m - rover.position_ecef_m).norm();
    }
    /// Root mean square over `epochs` seconds, with the base heard `late_s` before each, or not at all.
    double rmse_m(int epochs, std::optional<double> late_s) {
        double sum_m2 = 0;
        for (int i = 0; i < epochs; ++i) {
            const double at_s = 10 * i;
            if (late_s) hear(base_ranges(at_s - *late_s));
            hear(observed(rover, at_s), at_s);
            sum_m2 += std::pow(error_m(taken.fixes.back()), 2);
        }
        return std::sqrt(sum_m2 / epochs);
    }
};

TEST_F(BaseStationsTest, CorrectionsTakeOutWhatBothHaveAlike) {
    fresh();
    const double alone_m = rmse_m(30, {});
    EXPECT_EQ(taken.fixes.back().fix_type, gnss_fix_type::full);
    const float alone_sigma_m = taken.fixes.back().sigma_horizontal_m;
    fresh();
    const double corrected_m = rmse_m(30, 1.5);
    RecordProperty("alone_mm", static_cast<int>(1000 * alone_m));
    RecordProperty("corrected_mm", static_cast<int>(1000 * corrected_m));
    EXPECT_LT(corrected_m, 0.5 * alone_m) << "3D";
    EXPECT_LT(corrected_m, 1.5);
    EXPECT_EQ(taken.fixes.back().fix_type, gnss_fix_type::differential);
    EXPECT_LT(taken.fixes.back().sigma_horizontal_m, 0.8F * alone_sigma_m);
}

/// Errors of fixes over their standard deviations, three a fix: with 0.84 m of noise for each receiver, as the model
/// has it at 45 dBHz, and none of its multipath they must not be larger than told, and not so small that the model says
/// nothing.
TEST_F(BaseStationsTest, CorrectedFixesAreAsSureAsTheySay) {
    own_noise_m = 150 * std::pow(10, -45.0 / 20);
    fresh();
    double sum = 0;
    constexpr int epochs = 40;
    for (int i = 0; i < epochs; ++i) {
        hear(base_ranges(10 * i - 1));
        hear(observed(rover, 10 * i), 10 * i);
        const GnssFix& fix = taken.fixes.back();
        const Eigen::Vector3d at_m = ecef_m({fix.latitude_deg, fix.longitude_deg, fix.height_ellipsoid_m});
        const Eigen::Matrix3d axes = enu_to_ecef(geodetic(rover.position_ecef_m));
        const Eigen::Vector3d enu_m = axes.transpose() * (at_m - rover.position_ecef_m);
        const auto horizontal_m = static_cast<double>(fix.sigma_horizontal_m);
        sum += enu_m.head<2>().squaredNorm() / (horizontal_m * horizontal_m) +
               std::pow(enu_m.z() / static_cast<double>(fix.sigma_vertical_m), 2);
    }
    const double mean = sum / (3 * epochs);
    RecordProperty("mean_squared_ratio_percent", static_cast<int>(100 * mean));
    EXPECT_LT(mean, 1.3);
    EXPECT_GT(mean, 0.4);
}

TEST_F(BaseStationsTest, TheBasesClockDoesNotMatter) {
    own_noise_m = 0;
    std::vector<double> ranges_m;
    for (const double clock_m : {0.0, 299792.0, -3e5}) {
        fresh();
        base.clocks_m = {clock_m, clock_m + 100, clock_m - 50, clock_m};
        hear(base_ranges(0));
        hear(observed(rover, 1), 1);
        const GnssFix& fix = taken.fixes.at(0);
        EXPECT_LT(error_m(fix), 0.4) << "the way of 7 km leaves";
        ranges_m.push_back(taken.ranges.at(0).pseudorange_m);
    }
    EXPECT_LT(std::ranges::max(ranges_m) - std::ranges::min(ranges_m), 40) << "nor does a filter's clock see it";
}

TEST_F(BaseStationsTest, SatellitesThatTheBaseDoesNotHearAreUsedAsBefore) {
    fresh();
    const double alone_m = rmse_m(20, {});
    fresh();
    double sum_m2 = 0;
    for (int i = 0; i < 20; ++i) {
        auto half = base_ranges(10 * i);
        std::erase_if(half, [](const GnssBaseRange& r) { return r.satellite % 2 == 0; });
        hear(half);
        hear(observed(rover, 10 * i), 10 * i);
        sum_m2 += std::pow(error_m(taken.fixes.back()), 2);
    }
    EXPECT_LT(std::sqrt(sum_m2 / 20), alone_m) << "no clock of the base's is mixed in: that would be kilometres";
}

/// From the last corrected fix to the first without: no further than three standard deviations of the latter.
TEST_F(BaseStationsTest, ALostBaseLeavesNoJumpLargerThanTheErrorsThemselves) {
    settings.max_correction_age_s = 10;
    fresh();
    hear(base_ranges(0));
    std::vector<GnssFix> fixes;
    for (int i = 1; i <= 20; ++i) {
        hear(observed(rover, i), i);
        fixes.push_back(taken.fixes.back());
    }
    EXPECT_EQ(fixes[9].fix_type, gnss_fix_type::differential) << "10 s old";
    EXPECT_EQ(fixes[10].fix_type, gnss_fix_type::full) << "11 s old";
    const auto place_m = [](const GnssFix& f) {
        return ecef_m({f.latitude_deg, f.longitude_deg, f.height_ellipsoid_m});
    };
    const double jump_m = (place_m(fixes[10]) - place_m(fixes[9])).norm();
    EXPECT_LT(jump_m, 3 * std::hypot(double{fixes[10].sigma_horizontal_m}, double{fixes[10].sigma_vertical_m}));
}

TEST_F(BaseStationsTest, OneSatelliteThatIsWrongAtTheBaseCorrectsNothing) {
    fresh();
    auto ranges = base_ranges(0);
    ranges[3].pseudorange_m += 80;
    hear(ranges);
    hear(observed(rover, 1), 1);
    EXPECT_LT(error_m(taken.fixes.at(0)), 2);
    EXPECT_EQ(taken.fixes[0].fix_type, gnss_fix_type::differential);
    hear(base_ranges(1));
    EXPECT_EQ(said.front(), Exclusion::none) << "the others correct";
}

TEST_F(BaseStationsTest, ABaseThatStandsElsewhereThanItSaysIsNotUsed) {
    fresh();
    for (int i = 0; i < 2; ++i) {
        auto ranges = base_ranges(i);
        for (GnssBaseRange& range : ranges) range.antenna_ecef_m[0] += 300;
        hear(ranges);
        hear(observed(rover, i + 0.5), i + 0.5);
    }
    EXPECT_EQ(said.front(), Exclusion::inconsistent);
    EXPECT_EQ(taken.fixes.back().fix_type, gnss_fix_type::full);
    EXPECT_LT(error_m(taken.fixes.back()), 15);
}

TEST_F(BaseStationsTest, EveryRangeOfABaseHasItsReason) {
    fresh();
    auto ranges = base_ranges(5);
    hear(ranges);
    EXPECT_EQ(said.front(), Exclusion::nothing_to_correct) << "no receiver yet";
    hear(ranges);
    EXPECT_EQ(said.front(), Exclusion::duplicate);
    hear(observed(rover, 6), 6);
    ranges = base_ranges(6);
    ranges[1].antenna_ecef_m = unknown_vec3;
    ranges[2].signal = 3;
    ranges[3].pseudorange_m = 7;
    ranges[4].carrier_to_noise_dbhz = 3;
    ranges[5].time_s_in_gps_week = -1;
    ranges[6].time_s_in_gps_week -= 4;
    ranges[7].satellite = 200;
    hear(ranges);
    const std::vector wanted{
        Exclusion::none,     Exclusion::base_without_place, Exclusion::other_signal, Exclusion::impossible_range,
        Exclusion::too_weak, Exclusion::impossible_time,    Exclusion::late,         Exclusion::no_ephemeris,
        Exclusion::none};
    for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_EQ(said[i], wanted[i]) << i;
    hear(base_ranges(100));
    EXPECT_EQ(said.front(), Exclusion::nothing_to_correct) << "the receiver is gone";
}

TEST_F(BaseStationsTest, FarBasesAndOldOnesAreBelievedLess) {
    fresh();
    hear(base_ranges(0));
    hear(observed(rover, 1), 1);
    const float near_m = taken.fixes.back().sigma_horizontal_m;
    hear(observed(rover, 25), 25);
    EXPECT_GT(taken.fixes.back().sigma_horizontal_m, near_m);
    base.position_ecef_m = ecef_m({48.9, 12.2, 540}); // 100 km
    fresh();
    hear(base_ranges(0));
    hear(observed(rover, 1), 1);
    EXPECT_GT(taken.fixes.back().sigma_horizontal_m, 1.02F * near_m);
}

TEST_F(BaseStationsTest, OfTwoBasesTheNearerOneCorrects) {
    fresh();
    const synthetic::Truth near_one = base;
    hear(base_ranges(0));
    hear(observed(rover, 1), 1);
    const float near_m = taken.fixes.back().sigma_horizontal_m;
    for (const Address far_one : {address(1), address(4000)}) {
        base.position_ecef_m = ecef_m({49.9, 13.2, 540});
        auto ranges = base_ranges(1);
        for (GnssBaseRange& range : ranges) range.base = far_one;
        hear(ranges);
    }
    base = near_one;
    hear(observed(rover, 1.5), 1.5);
    EXPECT_NEAR(taken.fixes.back().sigma_horizontal_m, near_m, 0.01F * near_m);
}

/// More bases than there is room for, and numbers out of all bounds; seed 11. Nothing is allocated.
TEST_F(BaseStationsTest, HostileBasesLeaveFiniteNumbersOnly) {
    fresh();
    taken.fixes.reserve(1000);
    taken.ranges.reserve(100000);
    const std::array<double, 7> odd{0, -1, 1e300, -1e300, 2.2e7, 604799, unknown_d};
    std::vector<std::vector<GnssBaseRange>> heard;
    std::vector<std::vector<GnssRaw>> rovers;
    for (int i = 0; i < 30; ++i) heard.push_back(base_ranges(i)), rovers.push_back(observed(rover, i + 0.5));
    said.reserve(1000);
    const test::AllocationCount allocations;
    for (std::size_t i = 0; i < heard.size(); ++i) {
        for (GnssBaseRange range : heard[i]) {
            if (random() % 9 == 0) range.pseudorange_m = odd[random() % odd.size()];
            if (random() % 9 == 0) range.time_s_in_gps_week = odd[random() % odd.size()];
            if (random() % 20 == 0) range.antenna_ecef_m[random() % 3] = odd[random() % odd.size()];
            if (random() % 9 == 0) range.satellite = static_cast<std::uint8_t>(random());
            if (random() % 9 == 0) range.constellation = static_cast<std::uint8_t>(random() % 8);
            if (random() % 9 == 0) range.glonass_slot = static_cast<std::uint8_t>(random());
            if (random() % 9 == 0) range.base = address(random() % 9);
            if (random() % 9 == 0) range.carrier_to_noise_dbhz = random() % 2 ? 3e38F : unknown_f;
            said.push_back(receivers->hear(range, 1));
        }
        hear(rovers[i], static_cast<double>(i) + 0.5);
    }
    EXPECT_EQ(allocations.made(), 0u);
    ASSERT_GE(taken.fixes.size(), 25u);
    for (const GnssFix& fix : taken.fixes) EXPECT_LT(error_m(fix), 40);
    for (const SatelliteRange& range : taken.ranges)
        EXPECT_TRUE(std::isfinite(range.pseudorange_m + double{range.sigma_m}));
}

} // namespace
} // namespace locus::gnss
