// Files of receivers imported whole: how much is in them, their first and last values, and positions out of RINEX as
// good as single points are there.
#include "drivers/recording/measurement_json.h"
#include "fusion/gnss/ephemeris_collector.h"
#include "tests/replay/data.h"
#include "tests/replay/single_point.h"
#include "tests/support/temporary_folder.h"
#include "tools/import/import.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <set>

namespace locus::importing {
namespace {

using gnss::GpsTime;

struct Imported {
    std::vector<FileReport> reports;
    std::vector<Measurement> measurements;
    std::map<std::string_view, std::size_t> counts;
};

Imported import(const std::vector<std::filesystem::path>& paths) {
    const test::TemporaryFolder folder;
    Request request{{}, folder / "recording.jsonl"};
    for (const auto& path : paths) request.files.push_back(path.string());
    Imported imported;
    imported.reports = import_files(request);
    std::ifstream file(request.output);
    std::string error;
    for (std::string line; std::getline(file, line);) {
        const auto measurement = from_json_line(line, error);
        EXPECT_TRUE(measurement) << error;
        if (measurement) imported.measurements.push_back(*measurement);
    }
    for (const auto& m : imported.measurements) ++imported.counts[observation_names[m.observation.index()]];
    const bool in_order = std::ranges::is_sorted(imported.measurements, {}, &Measurement::time);
    EXPECT_TRUE(in_order || paths.size() == 1);
    return imported;
}

template <class Kind>
std::vector<Kind> all_of(const Imported& imported) {
    std::vector<Kind> all;
    for (const auto& m : imported.measurements)
        if (const auto* one = std::get_if<Kind>(&m.observation)) all.push_back(*one);
    return all;
}

TEST(Import, WalkOfAnUbxLog) {
    const auto log = test::recorded("gnss_imu_walk_drive/walk_0827/gnss_1730.ubx");
    if (!log) GTEST_SKIP() << "no gnss_imu_walk_drive in LOCUS_DATA or ../shared/data";
    const auto walk = import({*log});
    EXPECT_EQ(walk.counts.at("GNSS_FIX"), 536u);
    EXPECT_EQ(walk.counts.at("GNSS_RAW"), 37850u);
    EXPECT_EQ(walk.counts.at("GNSS_NAVIGATION"), 2328u - 51) << "51 have more than 16 words";
    EXPECT_EQ(walk.reports[0].refused[static_cast<std::size_t>(Refusal::bad_checksum)], 0u);
    EXPECT_EQ(walk.reports[0].bad, 0u);
    constexpr double week_begin_s = 2381 * 604800.0;
    EXPECT_EQ(walk.measurements.front().time, timestamp_from_s(week_begin_s + 408639.748));
    EXPECT_EQ(walk.measurements.back().time, timestamp_from_s(week_begin_s + 408773.5)) << "iTOW of the last NAV-PVT";
}

TEST(Import, DriveOfAnNmeaLog) {
    const auto log = test::recorded("google_gnss/NmeaUtils/example/MTV.Local1.ublox-F9K.20200206-181434.nmea");
    if (!log) GTEST_SKIP() << "no google_gnss in LOCUS_DATA or ../shared/data";
    const auto drive = import({*log});
    EXPECT_EQ(drive.counts.at("GNSS_FIX"), 1653u);
    EXPECT_EQ(drive.reports[0].refused[static_cast<std::size_t>(Refusal::bad_checksum)], 13u);
    // 02:14:17 on 7 February 2020 in UTC: day 14647 since 1980-01-06, 18 leap seconds.
    EXPECT_EQ(drive.measurements.front().time, timestamp_from_s(14642 * 86400.0 + 8057 + 18));
    EXPECT_EQ(drive.measurements.back().time - drive.measurements.front().time, std::chrono::seconds{1727});
}

Imported hong_kong() {
    const std::string folder = "graphgnss_hk_tst/gps_solution_TST/";
    std::vector<std::filesystem::path> paths;
    for (const char* name : {"COM3_190428_124409.obs", "hksc1180.19n", "hksc1180.19b"})
        if (const auto path = test::recorded(folder + name)) paths.push_back(*path);
    return paths.size() == 3 ? import(paths) : Imported{};
}

TEST(Import, CanyonOfRinex) {
    const auto canyon = hong_kong();
    if (canyon.measurements.empty()) GTEST_SKIP() << "no graphgnss_hk_tst in LOCUS_DATA or ../shared/data";
    for (const auto& report : canyon.reports) EXPECT_EQ(report.bad, 0u) << report.path;
    const auto raws = all_of<GnssRaw>(canyon);
    EXPECT_EQ(raws.size(), 26146u) << "lines of satellites in the file";
    EXPECT_EQ(raws.front().pseudorange_m, 21600712.022);
    EXPECT_EQ(raws.front().carrier_cycles, 113512506.876);
    EXPECT_EQ(raws.front().doppler_hz, 445.146);
    EXPECT_EQ(raws.front().receiver_time_s_in_gps_week, 45873.997);
    EXPECT_EQ(raws.front().gps_week, 2051);
    EXPECT_EQ(raws.back().pseudorange_m, 37992919.895);
    EXPECT_EQ(raws.back().satellite, 13);
    std::set<double> epochs;
    for (const auto& raw : raws) epochs.insert(raw.receiver_time_s_in_gps_week);
    EXPECT_EQ(epochs.size(), 1760u);
}

struct Truth {
    std::map<long, Eigen::Vector3d> position_m; ///< by second of the week
};

Truth read_truth(const std::filesystem::path& path) {
    Truth truth;
    std::ifstream file(path);
    double week = 0, second = 0, latitude_deg = 0, longitude_deg = 0, height_m = 0;
    for (std::string line; std::getline(file, line);)
        if (std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf", &week, &second, &latitude_deg, &longitude_deg,
                        &height_m) == 5)
            truth.position_m[std::lround(second)] = test::ecef_m(latitude_deg, longitude_deg, height_m);
    return truth;
}

/// Goes through the recording as an estimator would: ephemerides as they come, a position at each epoch's end.
class SinglePoints {
  public:
    explicit SinglePoints(std::set<std::uint8_t> constellations) : constellations_{std::move(constellations)} {}

    void take(const Measurement& m) {
        if (const auto* raw = std::get_if<GnssRaw>(&m.observation)) take(*raw);
        if (const auto* words = std::get_if<GnssNavigation>(&m.observation))
            if (const auto e = collector_.add(*words, now_))
                if (const auto* kepler = std::get_if<gnss::KeplerEphemeris>(&*e))
                    known_[{kepler->constellation, kepler->satellite}] = *kepler;
    }

    /// Position by second of the week, of epochs with at least one satellite more than is needed.
    std::map<long, Eigen::Vector3d> positions_m;

  private:
    std::set<std::uint8_t> constellations_;
    gnss::EphemerisCollector collector_;
    std::map<std::pair<unsigned, unsigned>, gnss::KeplerEphemeris> known_;
    std::vector<GnssRaw> epoch_;
    GpsTime now_;

    void take(const GnssRaw& raw) {
        const GpsTime time{raw.gps_week, raw.receiver_time_s_in_gps_week};
        if (time - now_ != 0) finish();
        now_ = time;
        if (constellations_.contains(raw.constellation)) epoch_.push_back(raw);
    }

    void finish() {
        std::vector<test::Ray> rays;
        for (const GnssRaw& raw : epoch_) {
            const auto found = known_.find({raw.constellation, raw.satellite});
            if (found == known_.end() || found->second.health != 0) continue;
            const auto& e = found->second;
            rays.push_back(test::ray_of(e, now_, raw.pseudorange_m, e.group_delay_s[0],
                                        raw.constellation == constellation::gps ? 3 : 4));
        }
        epoch_.clear();
        if (rays.size() < 4 + constellations_.size()) return;
        const Eigen::Vector3d first_m = test::position_m(rays);
        std::erase_if(rays, [&](const auto& ray) { return test::sine_of_elevation(first_m, ray.satellite_m) < 0.26; });
        if (rays.size() >= 4 + constellations_.size()) positions_m[std::lround(now_.second)] = test::position_m(rays);
    }
};

double median_horizontal_m(const SinglePoints& points, const Truth& truth, std::size_t& count) {
    std::vector<double> errors_m;
    for (const auto& [second, at_m] : points.positions_m)
        if (const auto found = truth.position_m.find(second); found != truth.position_m.end())
            errors_m.push_back(test::horizontal_m(at_m - found->second, found->second));
    count = errors_m.size();
    std::ranges::sort(errors_m);
    return errors_m.empty() ? 1e9 : errors_m[errors_m.size() / 2];
}

TEST(Import, SinglePointsOutOfRinexAreAsGoodAsTheyAreThere) {
    const auto canyon = hong_kong();
    const auto path = test::recorded("graphgnss_hk_tst/gps_solution_TST/groundTruth_TST.csv");
    if (!path || canyon.measurements.empty()) GTEST_SKIP() << "no graphgnss_hk_tst in LOCUS_DATA or ../shared/data";
    const Truth truth = read_truth(*path);
    for (const auto& constellations : {std::set{constellation::gps}, std::set{constellation::beidou},
                                       std::set{constellation::gps, constellation::beidou}}) {
        SinglePoints points{constellations};
        for (const auto& m : canyon.measurements) points.take(m);
        std::size_t count = 0;
        const double median_m = median_horizontal_m(points, truth, count);
        std::printf("constellation %d and %zu more: median %.1f m horizontally, %zu epochs\n", *constellations.begin(),
                    constellations.size() - 1, median_m, count);
        EXPECT_GT(count, 400u);
        EXPECT_LT(median_m, 18) << "between high houses; rtklib: 12.3 m with GPS alone";
    }
}

/// Positions by second of the week that Debian's rnx2rtkp computes from the files themselves, with GPS alone.
std::map<long, Eigen::Vector3d> rtklib_positions_m(const std::string& observations, const std::string& navigation) {
    const test::TemporaryFolder folder;
    const std::string command = "rnx2rtkp -p 0 -m 15 -sys G -e -o " + folder / "out.pos" + " '" + observations + "' '" +
                                navigation + "' >/dev/null 2>&1";
    if (std::system(command.c_str()) != 0) return {};
    std::map<long, Eigen::Vector3d> positions_m;
    std::ifstream file(folder / "out.pos");
    double week = 0, second = 0;
    for (std::string line; std::getline(file, line);)
        if (Eigen::Vector3d at;
            std::sscanf(line.c_str(), "%lf %lf %lf %lf %lf", &week, &second, &at[0], &at[1], &at[2]) == 5)
            positions_m[std::lround(second)] = at;
    return positions_m;
}

TEST(Import, SinglePointsOutOfRinexAreWhereRtklibFindsThem) {
    const std::string folder = "graphgnss_hk_tst/gps_solution_TST/";
    const auto observations = test::recorded(folder + "COM3_190428_124409.obs");
    const auto navigation = test::recorded(folder + "hksc1180.19n");
    if (!observations || !navigation) GTEST_SKIP() << "no graphgnss_hk_tst in LOCUS_DATA or ../shared/data";
    if (std::system("command -v rnx2rtkp >/dev/null 2>&1") != 0) GTEST_SKIP() << "no rnx2rtkp: apt install rtklib";
    const auto theirs_m = rtklib_positions_m(observations->string(), navigation->string());
    SinglePoints ours{{constellation::gps}};
    for (const auto& m : import({*observations, *navigation}).measurements) ours.take(m);
    std::vector<double> apart_m;
    for (const auto& [second, at_m] : theirs_m)
        if (const auto found = ours.positions_m.find(second); found != ours.positions_m.end())
            apart_m.push_back(test::horizontal_m(found->second - at_m, at_m));
    ASSERT_GT(apart_m.size(), 500u);
    std::ranges::sort(apart_m);
    std::printf("%zu epochs, from rtklib %.2f m horizontally in the median\n", apart_m.size(),
                apart_m[apart_m.size() / 2]);
    EXPECT_LT(apart_m[apart_m.size() / 2], 3) << "rtklib takes off the ionosphere as well";
}

} // namespace
} // namespace locus::importing
