// RTCM 3 against Debian's rtklib: its convbin reads the same out of the same bytes, and its rnx2rtkp, as differential
// GPS with the same base, comes no nearer to the truth. Base and receiver are simulated (seed 5) under the satellites
// of a real navigation file: there is no recording with both.
#include "drivers/gnss/rinex_observations.h"
#include "fusion/gnss/ephemeris_words.h"
#include "tests/replay/data.h"
#include "tests/replay/navigation_records.h"
#include "tests/replay/receiver_run.h"
#include "tests/replay/rinex_oracle.h"
#include "tests/replay/rnx2rtkp.h"
#include "tests/support/rtcm3_encoder.h"
#include "tests/unit/drivers/collector.h"
#include "tests/unit/fusion/gnss/synthetic_sky.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace locus::gnss {
namespace {

namespace encoder = test::rtcm3;

void append_frame(encoder::Bytes& stream, const encoder::Bytes& frame) {
    stream.insert(stream.end(), frame.begin(), frame.end());
}

/// What convbin makes of a stream, in `path` as RINEX 3.
void convert_rtcm3(const encoder::Bytes& stream, const std::string& day, const std::string& path) {
    std::ofstream(path + ".rtcm3", std::ios::binary)
        .write(reinterpret_cast<const char*>(stream.data()), static_cast<std::streamsize>(stream.size()));
    const std::string command = "convbin -r rtcm3 -tr " + day + " 00:00:00 -od -os -v 3.03 -o '" + path + "' '" + path +
                                ".rtcm3' >/dev/null 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0);
}

std::vector<GnssRaw> read_converted(const std::string& path) {
    rinex::Observations observations{address(1)};
    test::Collector sink;
    std::ifstream file(path);
    std::string error;
    for (std::string line; std::getline(file, line);) observations.read(line, sink, error);
    EXPECT_EQ(error, "");
    return sink.all<GnssRaw>();
}

std::vector<GnssBaseRange> decode_base(const encoder::Bytes& stream) {
    test::Collector sink;
    test::default_decoder("rtcm3")->decode(test::bytes_packet(stream), sink);
    return sink.all<GnssBaseRange>();
}

TEST(Rtcm3Oracle, ConvbinReadsTheSame) {
    if (!test::convbin_installed()) GTEST_SKIP() << "no convbin (rtklib)";
    std::mt19937 random{5};
    const auto below = [&](unsigned end) { return static_cast<unsigned>(random() % end); };
    const auto cells = [&](unsigned last) {
        std::vector<encoder::Cell> some;
        for (unsigned satellite = 1; satellite <= last; satellite += 3) // GLONASS: each has its channel
            some.push_back({satellite, 2, 1.95e7 + 1e-3 * below(4'000'000'000), 30.0 + below(20), 1 + satellite % 13});
        return some;
    };
    encoder::Bytes stream;
    for (const unsigned kind : {4u, 5u, 6u, 7u})
        for (std::uint64_t i = 0; i < 3; ++i) { // the 28th of August 2025 is a Thursday
            const std::uint64_t ms = 345'600'000 + 10'000 * kind + 1000 * i;
            append_frame(stream, encoder::msm(1070 + kind, 7, ms, cells(32)));
            append_frame(stream,
                         encoder::msm(1080 + kind, 7, encoder::glonass_time(4, ms - 345'600'000 + 10'800'000 - 18'000),
                                      cells(24)));
            append_frame(stream, encoder::msm(1090 + kind, 7, ms, cells(36)));
            append_frame(stream, encoder::msm(1110 + kind, 7, ms, cells(7)));
            append_frame(stream, encoder::msm(1120 + kind, 7, ms - 14'000, cells(37)));
        }
    append_frame(stream, encoder::gps_l1(7, 345'690'000, cells(32)));
    const test::TemporaryFolder folder;
    convert_rtcm3(stream, "2025/08/28", folder / "out.obs");
    auto theirs = read_converted(folder / "out.obs");
    const auto ours = decode_base(stream);
    ASSERT_GT(ours.size(), 400u);
    EXPECT_EQ(ours.size(), theirs.size());
    for (const GnssBaseRange& range : ours) {
        const auto same = std::ranges::find_if(theirs, [&](const GnssRaw& raw) {
            return raw.constellation == range.constellation && raw.satellite == range.satellite &&
                   std::abs(raw.receiver_time_s_in_gps_week - range.time_s_in_gps_week) < 1e-6;
        });
        ASSERT_NE(same, theirs.end()) << int{range.constellation} << " " << int{range.satellite};
        EXPECT_NEAR(same->pseudorange_m, range.pseudorange_m, 0.0006) << "printed to the millimetre";
        EXPECT_NEAR(same->carrier_to_noise_dbhz, range.carrier_to_noise_dbhz, 0.26);
        EXPECT_EQ(same->signal, range.signal);
    }
}

/// Differential GPS by rtklib: the fixes by second of the week.
std::map<long, test::RtklibFix> rtklib_differential(const std::string& rover, const std::string& base,
                                                    const std::string& navigation, const Eigen::Vector3d& base_ecef_m) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "conf") << "pos1-posmode=dgps\npos1-elmask=10\npos1-ionoopt=brdc\npos1-tropopt=saas\n"
                                   << "pos1-sateph=brdc\npos1-navsys=1\nout-solformat=xyz\nout-timesys=gpst\n"
                                   << "out-timeform=tow\nant2-postype=xyz\n"
                                   << std::fixed << "ant2-pos1=" << base_ecef_m.x() << "\nant2-pos2=" << base_ecef_m.y()
                                   << "\nant2-pos3=" << base_ecef_m.z() << "\n";
    const std::string command = "rnx2rtkp -k " + folder / "conf" + " -o " + folder / "out.pos" + " '" + rover + "' '" +
                                base + "' '" + navigation + "' >/dev/null 2>&1";
    test::Rtklib read;
    if (std::system(command.c_str()) == 0) test::rtklib::read_fixes(folder / "out.pos", read);
    return read.fixes;
}

struct Sky2019 {
    std::vector<rinex::NavigationRecord> records; ///< of each satellite the one nearest to `time`
    GpsTime time;
};

/// The middle of the navigation file.
Sky2019 sky_of(const test::NavigationRecords& file) {
    std::map<unsigned, rinex::NavigationRecord> nearest;
    const auto toe_s = [](const rinex::NavigationRecord& r) { return std::get<KeplerEphemeris>(r.ephemeris).toe_s; };
    const auto& middle = std::get<KeplerEphemeris>(file.records[file.records.size() / 2].ephemeris);
    const GpsTime time{middle.week, std::floor(middle.toe_s / 60) * 60 + 300};
    for (const auto& record : file.records) {
        const auto& e = std::get<KeplerEphemeris>(record.ephemeris);
        if (e.week != time.week || e.health != 0 || std::abs(e.toe_s - time.second) > 3600) continue;
        const auto [at, is_new] = nearest.try_emplace(e.satellite, record);
        if (!is_new && std::abs(e.toe_s - time.second) < std::abs(toe_s(at->second) - time.second)) at->second = record;
    }
    Sky2019 sky{{}, time};
    for (const auto& [satellite, record] : nearest) sky.records.push_back(record);
    return sky;
}

struct Heard {
    std::vector<GnssRaw> raws;
    encoder::Bytes message;
};

/// Errors of 1 m of orbit by satellite and 0.8 of Klobuchar's delay are those of both; 0.5 m of noise each has alone.
Heard observe(const Sky2019& sky, const synthetic::Truth& truth, double after_s, std::mt19937& random) {
    std::normal_distribution<double> noise_m(0, 0.5);
    std::vector<encoder::Cell> cells;
    Heard heard;
    for (const auto& record : sky.records) {
        const auto& e = std::get<KeplerEphemeris>(record.ephemeris);
        const synthetic::Way way = synthetic::way(e, truth, sky.time + after_s, 0);
        if (way.elevation_rad < 0.15) continue;
        std::mt19937 of_satellite{e.satellite + 100u};
        GnssRaw raw = synthetic::observe(e, truth, sky.time + after_s);
        raw.pseudorange_m +=
            std::normal_distribution<double>{}(of_satellite) + 0.8 * way.ionosphere_m + noise_m(random);
        raw.carrier_cycles = raw.doppler_hz = 0;
        cells.push_back({e.satellite, 2, raw.pseudorange_m, 45});
        heard.raws.push_back(raw);
    }
    heard.message =
        encoder::msm(1077, 7, static_cast<std::uint64_t>(std::llround((sky.time + after_s).second * 1000)), cells);
    return heard;
}

TEST(Rtcm3Oracle, CorrectedPositionsAreAsGoodAsRtklibsDifferentialGps) {
    const auto navigation = test::recorded("graphgnss_hk_tst/gps_solution_TST/hksc1180.19n");
    if (!navigation || !test::convbin_installed() || !test::rnx2rtkp_installed())
        GTEST_SKIP() << "no graphgnss_hk_tst in LOCUS_DATA or ../shared/data, or no rtklib";
    const Sky2019 sky = sky_of(test::read_navigation_records(*navigation));
    ASSERT_GE(sky.records.size(), 8u);
    const synthetic::Truth rover{ecef_m({22.30, 114.18, 30}), Eigen::Vector3d::Zero(), {21e3, 0, 0, 0}, 0};
    const synthetic::Truth base{ecef_m({22.34, 114.14, 80}), Eigen::Vector3d::Zero(), {-9e4, 0, 0, 0}, 0};
    test::ReceiverRun corrected{GnssSettings{}}, alone{GnssSettings{}};
    std::mt19937 random{5};
    encoder::Bytes rover_stream, base_stream = encoder::place(1006, 7, base.position_ecef_m);
    constexpr int epochs = 60;
    for (int i = 0; i < epochs; ++i) {
        const Heard at_base = observe(sky, base, 10 * i, random), at_rover = observe(sky, rover, 10 * i, random);
        append_frame(base_stream, at_base.message);
        append_frame(rover_stream, at_rover.message);
        const Timestamp now = timestamp_from_s(1000 + 10 * i);
        for (auto range : decode_base(at_base.message)) {
            for (int axis = 0; axis < 3; ++axis)
                range.antenna_ecef_m[static_cast<std::size_t>(axis)] = base.position_ecef_m[axis];
            corrected.hear({now, 0, 1, range});
        }
        for (test::ReceiverRun* run : {&corrected, &alone}) {
            for (const GnssRaw& raw : at_rover.raws) run->hear({now, 0, 0, raw});
            for (std::size_t r = 0; r < sky.records.size() && i == 0; ++r)
                for (const auto& words : encode(sky.records[r].ephemeris, sky.time, 18)) run->hear({now, 0, 0, words});
        }
    }
    corrected.finish();
    alone.finish();
    const test::TemporaryFolder folder;
    convert_rtcm3(base_stream, "2019/04/28", folder / "base.obs");
    convert_rtcm3(rover_stream, "2019/04/28", folder / "rover.obs");
    const auto theirs =
        rtklib_differential(folder / "rover.obs", folder / "base.obs", navigation->string(), base.position_ecef_m);
    ASSERT_GE(theirs.size(), 55u);
    const auto rmse_m = [&](const auto& places_m) {
        double sum_m2 = 0;
        for (const Eigen::Vector3d& at_m : places_m) sum_m2 += (at_m - rover.position_ecef_m).squaredNorm();
        return std::sqrt(sum_m2 / static_cast<double>(places_m.size()));
    };
    const auto ours_of = [](const test::ReceiverRun& run) {
        std::vector<Eigen::Vector3d> places_m;
        for (const auto& fix : run.fixes) places_m.push_back(fix.ecef_m());
        return places_m;
    };
    std::vector<Eigen::Vector3d> their_places_m;
    for (const auto& [second, fix] : theirs) their_places_m.push_back(fix.position_ecef_m);
    ASSERT_GE(corrected.fixes.size(), 58u);
    EXPECT_EQ(corrected.fixes.back().fix.fix_type, gnss_fix_type::differential);
    const double ours_m = rmse_m(ours_of(corrected)), alone_m = rmse_m(ours_of(alone)),
                 rtklib_m = rmse_m(their_places_m);
    std::printf(
        "%zu satellites known; errors in space, root mean square: alone %.2f m, corrected %.2f m, rtklib %.2f m\n",
        sky.records.size(), alone_m, ours_m, rtklib_m);
    EXPECT_LT(ours_m, 1.1 * rtklib_m);
    EXPECT_LT(ours_m, 0.5 * alone_m);
}

} // namespace
} // namespace locus::gnss
