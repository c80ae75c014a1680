// locus import: files told by what stands in them, one recording in order of time, and sentences for what cannot be.
#include "drivers/gnss/nmea_messages.h"
#include "drivers/gnss/ubx_messages.h"
#include "drivers/recording/measurement_json.h"
#include "tests/support/temporary_folder.h"
#include "tools/command.h"
#include "tools/import/file_kind.h"
#include "tools/import/import.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

namespace locus::importing {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string headed(std::string_view text, std::string_view label) { return fmt::format("{:<60}{:<20}\n", text, label); }
std::string rinex_version(std::string_view number, char type) {
    return headed(fmt::format("{:>9}{:11}{:<20}{:<20}", number, "", type, 'M'), "RINEX VERSION / TYPE");
}

const std::string observations = rinex_version("3.04", 'O') + headed("G    1 C1C", "SYS / # / OBS TYPES") +
                                 headed("R    1 C1C", "SYS / # / OBS TYPES") + headed("", "END OF HEADER") +
                                 "> 2020 01 02 17 00  0.0000000  0  2\nG05  21000000.123\nR09  20000000.000\n"
                                 "> 2020 01 02 17 30  0.0000000  0  1\nG05  21000001.123\n";

std::string glonass_record(std::string_view date, double second_in_day) {
    return fmt::format("R09 {} 1.000000000000D-05 0.000000000000D+00 {:18.12E}\n", date, second_in_day) +
           "     1.100000000000D+04 0.000000000000D+00 0.000000000000D+00 0.000000000000D+00\n"
           "     1.200000000000D+04 0.000000000000D+00 0.000000000000D+00-3.000000000000D+00\n"
           "     1.900000000000D+04 0.000000000000D+00 0.000000000000D+00 0.000000000000D+00\n";
}

const std::string navigation =
    rinex_version("3.04", 'N') + headed("", "END OF HEADER") + glonass_record("2020 01 02 00 15 00", 900) +
    glonass_record("2020 01 02 16 45 00", 60300) + glonass_record("2020 01 02 17 15 00", 62100) +
    glonass_record("2020 01 02 17 45 00", 63900);

std::string text_of(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

/// Two fixes, one over the end of the GPS week, with words before the first time and between.
std::string ubx_log() {
    using namespace gnss::ubx;
    NavPvt pvt;
    pvt.time_of_week_ms = 604'799'900;
    pvt.year = 2020, pvt.month = 1, pvt.day = 4, pvt.hour = 23, pvt.minute = 59, pvt.second = 42;
    pvt.valid = 7, pvt.fix_type = 3, pvt.flags = 1;
    Subframe words;
    words.word_count = 10, words.satellite = 5;
    std::string log = text_of(encode(words)) + text_of(encode(pvt)) + "$GNTXT,noise\r\n" + text_of(encode(words));
    pvt.time_of_week_ms = 100;
    pvt.valid = 0;
    return log + text_of(encode(pvt));
}

/// Of a SLAM that was started again, with a line of something else.
const std::string poses = "# timestamp tx ty tz qx qy qz qw\n1000 1 2 3 0 0 0 1\n1001 2 2 3 0 0 0 1\nDone.\n"
                          "500 0 0 0 0 0 0 1\n501 1 0 0 0 0 0 1\n";

class ImportTest : public testing::Test {
  protected:
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream{folder_ / name, std::ios::binary} << text;
        return folder_ / name;
    }
    std::string out() const { return folder_ / "out.jsonl"; }

    std::vector<FileReport> import(const std::vector<std::string>& files) const {
        return import_files({files, out(), address(7), true});
    }
    std::vector<Measurement> written() const {
        std::vector<Measurement> all;
        std::ifstream file(out());
        std::string error;
        for (std::string line; std::getline(file, line);)
            if (const auto one = from_json_line(line, error)) all.push_back(*one);
        EXPECT_EQ(error, "");
        return all;
    }
    static int run(const std::string& arguments) {
        CLI::App app;
        int exit_code = -1;
        add_import(app, exit_code);
        app.parse(arguments);
        return exit_code;
    }
    std::string refusal(const std::string& text) const {
        try {
            kind_of_file(write("refused", text));
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "";
    }

    test::TemporaryFolder folder_;
};

TEST_F(ImportTest, NavigationComesWhenTheSatelliteSaidIt) {
    const auto reports = import({write("a", navigation), write("b", observations)});
    const auto all = written();
    ASSERT_EQ(all.size(), 3u + 3 * 4 - 4);
    const Timestamp begin = all[0].time;
    EXPECT_TRUE(std::holds_alternative<GnssRaw>(all[0].observation) &&
                std::holds_alternative<GnssRaw>(all[1].observation))
        << "who reads it knows the time before there are words";
    EXPECT_EQ(std::get<GnssRaw>(all[1].observation).glonass_slot, 4) << "channel -3 of the navigation file";
    EXPECT_EQ(all[0].input, 1);
    for (std::size_t i = 2; i < 6; ++i) {
        EXPECT_TRUE(std::holds_alternative<GnssNavigation>(all[i].observation));
        EXPECT_EQ(all[i].time, begin) << "the last said before comes at the beginning";
        EXPECT_EQ(all[i].input, 0);
        EXPECT_EQ(std::get<GnssNavigation>(all[i].observation).tag, address(7));
    }
    EXPECT_EQ(all[6].time - begin, std::chrono::minutes{15} + std::chrono::seconds{18});
    EXPECT_TRUE(std::ranges::is_sorted(all, {}, &Measurement::time));
    EXPECT_EQ(reports[0].left_out.at("records that newer ones replace before the first observation"), 1u);
    EXPECT_EQ(reports[0].left_out.at("words after the last observation"), 4u);
}

TEST_F(ImportTest, NavigationAloneIsGivenWhole) {
    import({write("a", navigation)});
    EXPECT_EQ(written().size(), 16u);
}

TEST_F(ImportTest, AnUbxLogIsDatedByTheReceiver) {
    const auto reports = import({write("walk", ubx_log())});
    const auto all = written();
    ASSERT_EQ(all.size(), 4u);
    const Timestamp first = timestamp_from_s(2086 * 604800.0 + 604799.9);
    EXPECT_EQ(all[0].time, first) << "words that came before any time was told";
    EXPECT_EQ(all[1].time, first);
    EXPECT_EQ(all[2].time, first);
    EXPECT_EQ(all[3].time, first + std::chrono::milliseconds{200}) << "over the week's end, without a valid date";
    EXPECT_EQ(reports[0].kind, "UBX log");
}

TEST_F(ImportTest, AnNmeaLogIsDatedByItsDates) {
    gnss::nmea::Gga gga;
    gga.latitude_deg = 50, gga.longitude_deg = 8, gga.quality = 1, gga.satellites = 9, gga.horizontal_dilution = 1;
    gga.altitude_sea_level_m = 100, gga.geoid_separation_m = 48;
    gnss::nmea::Rmc rmc;
    rmc.valid = true, rmc.speed_knots = 0, rmc.course_deg = 0, rmc.date_ddmmyy = 311216;
    std::string log;
    for (const std::int64_t second : {86398, 86399, 0, 1}) { // the leap second of 2016 lies between
        if (second == 0) rmc.date_ddmmyy = 10117;
        gga.time_us = rmc.time_us = second * 1'000'000;
        log += encode(rmc) + encode(gga); // u-blox's order
    }
    import({write("drive", log)});
    const auto all = written();
    ASSERT_EQ(all.size(), 4u);
    for (std::size_t i = 0; i < all.size(); ++i)
        EXPECT_EQ(all[i].time, timestamp_from_s(1167264015.0 + static_cast<double>(i + i / 2))) << i;
}

TEST_F(ImportTest, PosesAreDatedByTheirStamps) {
    Request request{{write("poses", poses)}, out(), address(7), true};
    request.poses.camera = address(40);
    request.poses_shift_s = 10;
    const auto reports = import_files(request);
    const auto all = written();
    ASSERT_EQ(all.size(), 3u) << "the first after a restart could be a stray";
    const auto& second = std::get<VisualOdometry>(all[1].observation);
    EXPECT_EQ(all[1].time, timestamp_from_s(1011));
    EXPECT_EQ(second.tag, address(7));
    EXPECT_EQ(second.camera, address(40));
    EXPECT_EQ(second.position_odometry, (Vec3{2, 2, 3}));
    EXPECT_EQ(second.segment, 0u);
    EXPECT_EQ(all[2].time, timestamp_from_s(511));
    EXPECT_EQ(std::get<VisualOdometry>(all[2].observation).segment, 1u);
    EXPECT_EQ(reports[0].kind, "TUM poses");
    EXPECT_EQ(reports[0].clock, "the poses' clock");
    EXPECT_EQ(reports[0].refused[static_cast<std::size_t>(Refusal::malformed)], 1u);
    EXPECT_EQ(reports[0].refused[static_cast<std::size_t>(Refusal::out_of_range)], 1u);
}

TEST_F(ImportTest, ARecordingIsPutTogetherWithPoses) {
    std::string ranges = "# of a tag\n";
    for (const double time_s : {999.5, 1000.5, 1001.5})
        ranges += to_json_line({timestamp_from_s(time_s), 0, 5, Range{address(1), address(7), time_s}}) + '\n';
    const auto reports = import({write("a", poses.substr(0, poses.find("Done"))), write("b", ranges + "{}\n")});
    const auto all = written();
    ASSERT_EQ(all.size(), 5u);
    EXPECT_TRUE(std::ranges::is_sorted(all, {}, &Measurement::time));
    EXPECT_EQ(std::get<Range>(all[2].observation).range_m, 1000.5);
    EXPECT_EQ(all[2].input, 1) << "its file's place";
    EXPECT_THAT(reports[1].problems, ElementsAre(HasSubstr("line 5: ")));
}

TEST_F(ImportTest, WhatAFileIsStandsInIt) {
    EXPECT_EQ(kind_of_file(write("x", poses)), FileKind::tum);
    EXPECT_EQ(kind_of_file(write("x", "\r\n# remark\r\n1,0,0,0,0,0,0,1\r\n")), FileKind::tum);
    EXPECT_EQ(kind_of_file(write("x", to_json_line({{}, 0, 0, Range{address(1), address(2), 3}}) + "\n")),
              FileKind::measurements);
    EXPECT_THAT(refusal("1 2 3 4 5 6 7 8\n"), HasSubstr("nor TUM poses")) << "that is no attitude";
    EXPECT_EQ(kind_of_file(write("x", observations)), FileKind::rinex_observations);
    EXPECT_EQ(kind_of_file(write("x", navigation)), FileKind::rinex_navigation);
    EXPECT_EQ(kind_of_file(write("x", ubx_log())), FileKind::ubx);
    EXPECT_THAT(refusal(rinex_version("2.11", 'O')), HasSubstr("convbin -r rinex -v 3.04"));
    EXPECT_THAT(refusal(rinex_version("4.00", 'N')), HasSubstr("RINEX 4"));
    EXPECT_THAT(refusal(headed("1.0                 COMPACT RINEX FORMAT", "CRINEX VERS   / TYPE")),
                HasSubstr("crx2rnx"));
    EXPECT_THAT(refusal("\x1f\x8b\x08"), HasSubstr("gunzip"));
    EXPECT_THAT(refusal("hello\n"), HasSubstr("is neither RINEX nor a log of UBX or NMEA"));
    EXPECT_THAT(refusal(""), HasSubstr("is neither"));
    EXPECT_THROW(kind_of_file(folder_ / "nowhere"), std::runtime_error);
    EXPECT_THROW(kind_of_file(folder_.path()), std::runtime_error);
}

TEST_F(ImportTest, ProblemsAreToldWithTheirLine) {
    const auto reports = import({write("cut", observations + "rubbish\n" + std::string(9000, 'x') + "\n")});
    EXPECT_EQ(reports[0].bad, 2u);
    EXPECT_THAT(reports[0].problems, ElementsAre(HasSubstr("line 10: "), HasSubstr("line 11: it is longer")));
    EXPECT_EQ(written().size(), 2u) << "GLONASS without a channel is left out";
}

TEST_F(ImportTest, ExitCodes) {
    const std::string file = write("b", observations);
    EXPECT_EQ(run("import " + file + " -o " + out() + " --tag 3"), exit_yes);
    EXPECT_EQ(std::get<GnssRaw>(written().at(0).observation).tag, address(3));
    EXPECT_EQ(run("import " + file + " -o " + out()), exit_usage) << "it is there already";
    EXPECT_EQ(run("import " + file + " --force --json -o " + out()), exit_yes);
    EXPECT_EQ(run("import " + file + " -o " + (folder_ / "out.txt")), exit_usage);
    EXPECT_EQ(run("import " + write("p", poses) + " --force --tag 9 --poses-shift -900 --poses-gap 0.5 -o " + out()),
              exit_yes);
    EXPECT_EQ(written().size(), 1u) << "one second apart is too far";
    EXPECT_EQ(written().at(0).time, timestamp_from_s(100));
    EXPECT_EQ(std::get<VisualOdometry>(written().at(0).observation).camera, address(9));
    EXPECT_EQ(run("import /nowhere -o " + out() + " --force"), exit_usage);
    EXPECT_EQ(run("import " + write("empty", rinex_version("3.04", 'N') + headed("", "END OF HEADER")) +
                  " --force -o " + out()),
              exit_no);
}

} // namespace
} // namespace locus::importing
