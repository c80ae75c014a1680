// Satellites and single points against Debian's rtklib, with the same files and models: GPS and BeiDou in a city, where
// reflections are tens of metres long, so that a wrong weight or correction shows.
#include "fusion/geometry/vector.h"
#include "fusion/gnss/ephemeris_words.h"
#include "fusion/gnss/satellite.h"
#include "tests/replay/data.h"
#include "tests/replay/imported.h"
#include "tests/replay/navigation_records.h"
#include "tests/replay/receiver_run.h"
#include "tests/replay/rnx2rtkp.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <set>

namespace locus::gnss {
namespace {

struct City {
    std::filesystem::path observations, gps, beidou;
    std::vector<test::NavigationRecords> navigation;
};

std::optional<City> city() {
    const std::string folder = "graphgnss_hk_tst/gps_solution_TST/";
    const auto observations = test::recorded(folder + "COM3_190428_124409.obs");
    const auto gps = test::recorded(folder + "hksc1180.19n"), beidou = test::recorded(folder + "hksc1180.19b");
    if (!observations || !gps || !beidou || !test::rnx2rtkp_installed()) return std::nullopt;
    return City{
        *observations, *gps, *beidou, {test::read_navigation_records(*gps), test::read_navigation_records(*beidou)}};
}

constexpr const char* without_city = "no graphgnss_hk_tst in LOCUS_DATA or ../shared/data, or no rnx2rtkp (rtklib)";

/// As rtklib counts.
std::pair<unsigned, unsigned> satellite_of(int number) {
    constexpr int before_beidou = 105;
    return number > before_beidou ? std::pair<unsigned, unsigned>{constellation::beidou, number - before_beidou}
                                  : std::pair<unsigned, unsigned>{constellation::gps, number};
}

GpsTime reference_of(const KeplerEphemeris& e) {
    if (e.constellation != constellation::beidou) return {e.week, e.toe_s};
    return GpsTime{e.week + beidou_week_ahead, e.toe_s} + gps_minus_beidou_s;
}

/// The records of a satellite, that with the reference time nearest to `time` first, also of the future.
std::vector<const rinex::NavigationRecord*> nearest(const City& city, std::pair<unsigned, unsigned> which,
                                                    const GpsTime& time) {
    std::vector<const rinex::NavigationRecord*> all;
    for (const auto& file : city.navigation)
        for (const auto& record : file.records)
            if (const auto& e = std::get<KeplerEphemeris>(record.ephemeris);
                std::pair<unsigned, unsigned>{e.constellation, e.satellite} == which)
                all.push_back(&record);
    std::ranges::stable_sort(all, {}, [&](const auto* record) {
        return std::abs(time - reference_of(std::get<KeplerEphemeris>(record->ephemeris)));
    });
    return all;
}

TEST(Rtklib, SeesTheSatellitesToTheCentimetreWhereTheyAre) {
    const auto here = city();
    if (!here) GTEST_SKIP() << without_city;
    const auto theirs = test::rnx2rtkp({here->observations, here->gps, here->beidou}, 33, 15, true);
    std::set<int> compared;
    double worst_m = 0, worst_clock_m = 0;
    for (const auto& seen : theirs.satellites) {
        // Half-way between two reference times a few milliseconds decide which of them rtklib takes.
        constexpr double half_way_s = 1;
        const auto records = nearest(*here, satellite_of(seen.number), seen.time + half_way_s);
        const auto records_before = nearest(*here, satellite_of(seen.number), seen.time + -half_way_s);
        ASSERT_FALSE(records.empty());
        if (records[0] != records_before[0]) continue;
        const SatelliteState state = satellite_state(std::get<KeplerEphemeris>(records[0]->ephemeris), seen.time);
        worst_m = std::max(worst_m, (vector(state.position_ecef_m) - seen.position_ecef_m).norm());
        worst_clock_m = std::max(worst_clock_m, std::abs(state.clock_s - seen.clock_s) * light_mps);
        compared.insert(seen.number);
    }
    std::printf("%zu satellites, %zu times: %.4f m, clock %.4f m apart at most\n", compared.size(),
                theirs.satellites.size(), worst_m, worst_clock_m);
    EXPECT_GE(compared.size(), 15u);
    EXPECT_LT(worst_m, 0.01) << "times are printed to the microsecond, in which a satellite flies 4 mm";
    EXPECT_LT(worst_clock_m, 0.01);
}

/// rtklib's variances: nothing of C/N0, and user range accuracy as it is.
GnssSettings as_rtklib(double mask_deg) {
    GnssSettings settings;
    settings.elevation_mask_deg = mask_deg;
    settings.min_carrier_to_noise_dbhz = 0;
    settings.noise_at_0_dbhz_m = 0;
    settings.orbit_sigma_m = 2.4;
    return settings;
}

/// The two ephemerides of each satellite that are nearest to the recording's middle, which rtklib chooses from as well.
std::vector<GnssNavigation> words_of(const City& city, const GpsTime& begin) {
    constexpr double half_s = 880;
    std::vector<GnssNavigation> all;
    if (const auto air = encode(city.navigation[0].ionosphere.value_or(Klobuchar{}), 1, begin)) all.push_back(*air);
    for (const std::uint8_t constellation : {constellation::gps, constellation::beidou})
        for (std::uint8_t satellite = 1; satellite < 64; ++satellite) {
            auto records = nearest(city, {constellation, satellite}, begin + half_s);
            records.resize(std::min<std::size_t>(records.size(), 2));
            for (const auto* record : records)
                for (const auto& one : encode(record->ephemeris, record->sent, record->leap_s)) all.push_back(one);
        }
    return all;
}

test::ReceiverRun run(const City& city, const std::vector<Measurement>& raws, const std::set<std::uint8_t>& which,
                      const GnssSettings& settings) {
    test::ReceiverRun run{settings};
    std::size_t heard = 0;
    for (const Measurement& m : raws) {
        const GnssRaw& raw = std::get<GnssRaw>(m.observation);
        if (which.contains(raw.constellation)) run.hear(m);
        if (heard++ > 0) continue;
        for (const auto& words : words_of(city, time_of(raw)))
            if (which.contains(words.constellation)) run.hear({m.time, 0, 1, words});
    }
    run.finish();
    return run;
}

class RtklibFixes : public testing::TestWithParam<std::pair<int, std::set<std::uint8_t>>> {};

TEST_P(RtklibFixes, AreOursToTheDecimetre) {
    const auto here = city();
    if (!here) GTEST_SKIP() << without_city;
    const auto& [systems, which] = GetParam();
    constexpr int mask_deg = 20; // lower down our mapping of the troposphere is another one
    const auto theirs = test::rnx2rtkp({here->observations, here->gps, here->beidou}, systems, mask_deg);
    const auto ours = run(*here, test::import({here->observations}).measurements, which, as_rtklib(mask_deg));
    std::vector<double> apart_m;
    for (const auto& one : ours.fixes) {
        const double week_begin_s = std::floor(to_s(one.time) / week_s) * week_s;
        const auto found = theirs.fixes.find(std::lround(to_s(one.time) - week_begin_s));
        if (found == theirs.fixes.end() || found->second.satellites != one.fix.satellites) continue;
        apart_m.push_back((one.ecef_m() - found->second.position_ecef_m).norm());
    }
    ASSERT_GT(apart_m.size(), 200u);
    std::ranges::sort(apart_m);
    const double median_m = apart_m[apart_m.size() / 2], most_m = apart_m[apart_m.size() * 95 / 100];
    std::printf(
        "systems %d: %zu epochs (ours %zu, theirs %zu), apart %.3f m in the median, 95 %% %.3f m, most %.3f m\n",
        systems, apart_m.size(), ours.fixes.size(), theirs.fixes.size(), median_m, most_m, apart_m.back());
    EXPECT_LT(median_m, 0.1);
    EXPECT_LT(most_m, 0.1);
}

INSTANTIATE_TEST_SUITE_P(OfHongKong, RtklibFixes,
                         testing::Values(std::pair{1, std::set<std::uint8_t>{constellation::gps}},
                                         std::pair{33,
                                                   std::set<std::uint8_t>{constellation::gps, constellation::beidou}}));

} // namespace
} // namespace locus::gnss
