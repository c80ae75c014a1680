// A radio map from a running daemon: what it says of places and strengths, put together.
#include "config/radio_map.h"
#include "tests/unit/tools/fake_daemon.h"
#include "tools/survey/live.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace locus {
namespace {

/// A second of somebody who walks along x at 1 m/s, a beacon heard ten times, between two poses each time.
std::string walk(const std::string& kinds = R"("RANGE","IMU")") {
    std::string lines;
    for (int i = 0; i <= 10; ++i) {
        lines +=
            fmt::format(R"({{"class":"POSE","target":"anna","time":{},"position_site_m":[{},2,1],"kinds_used":[{}]}})"
                        "\n",
                        0.1 * i, 0.1 * i, kinds);
        lines += fmt::format(R"({{"class":"READING","target":"anna","time":{},"beacon":"0x90","rssi_dbm":-60}})"
                             "\n",
                             0.1 * i + 0.05);
    }
    return lines;
}

survey::LiveSurvey after(const std::string& lines, survey::LiveRequest request = {}) {
    survey::LiveSurvey survey(std::move(request));
    for (std::size_t at = 0, end = 0; (end = lines.find('\n', at)) != std::string::npos; at = end + 1)
        survey.take(tools::parse_message(lines.substr(at, end - at)));
    return survey;
}

survey::LiveRequest request_of(double cell_m, const std::optional<Vec3>& stood_site_m) {
    survey::LiveRequest request;
    request.cell_m = cell_m;
    request.stood_site_m = stood_site_m;
    return request;
}

TEST(LiveSurvey, PutsEachReadingWhereItWasHeard) {
    auto survey = after(walk(), request_of(4, {}));
    EXPECT_EQ(survey.progress().readings, 11U);
    EXPECT_EQ(survey.progress().poses, 11U);
    const auto collected = survey.finish();
    EXPECT_EQ(collected.readings, 10U);
    EXPECT_EQ(collected.unplaced, 1U) << "after the last pose nobody knows";
    ASSERT_EQ(collected.map.points.size(), 1U);
    EXPECT_NEAR(collected.map.points[0].position_site_m[0], 0.5, 1e-9) << "the mean of where it was heard";
    EXPECT_EQ(collected.map.points[0].heard[0].beacon, address(0x90));
    EXPECT_EQ(collected.map.points[0].heard[0].mean_dbm, -60);
}

TEST(LiveSurvey, DoesNotLearnFromPosesThatComeOfTheRadioItself) {
    auto survey = after(walk(R"("SIGNAL_STRENGTH","IMU")"));
    EXPECT_EQ(survey.progress().poses, 0U);
    EXPECT_EQ(survey.progress().poses_by_radio, 11U);
    EXPECT_EQ(survey.finish().readings, 0U);
}

TEST(LiveSurvey, WhoStandsNeedsNoPose) {
    auto survey = after(walk(R"("SIGNAL_STRENGTH")"), request_of(2, Vec3{3, 4, 1}));
    const auto collected = survey.finish();
    EXPECT_EQ(collected.readings, 11U);
    EXPECT_EQ(collected.map.points.at(0).position_site_m, (Vec3{3, 4, 1}));
}

TEST(LiveSurvey, LinesThatSayNothingArePassedOver) {
    auto survey = after(R"({"class":"READING","target":"anna"})"
                        "\n"
                        R"({"class":"READING","target":7,"time":"x","beacon":"zz","rssi_dbm":[]})"
                        "\n"
                        R"({"class":"POSE","target":"anna","time":1,"position_site_m":[1,2]})"
                        "\n");
    EXPECT_EQ(survey.progress().readings, 0U);
    EXPECT_EQ(survey.progress().poses, 0U);
}

TEST(LiveSurvey, IsACommand) {
    FakeDaemon daemon({{"?WATCH", R"({"class":"WATCH","enable":true})"
                                  "\n" +
                                      walk()}});
    const std::string path = daemon.folder() + "/map.yaml";
    const auto run = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"survey", "-o", path};
        words.insert(words.end(), more.begin(), more.end());
        return run_locus({add_survey}, words);
    };
    EXPECT_EQ(run({}).exit_code, 2) << "neither recordings nor --live";
    EXPECT_EQ(run({"--live", "--socket", daemon.folder() + "/none"}).exit_code, 3);
    const auto good =
        run({"--live", "--socket", daemon.path(), "--seconds", "0.5", "--cell", "0.25", "--site", "hall"});
    EXPECT_EQ(good.exit_code, 0) << good.err;
    std::vector<ConfigProblem> problems;
    const auto map = config::load_radio_map(path, problems);
    ASSERT_TRUE(map.has_value());
    EXPECT_EQ(map->site, "hall");
    EXPECT_EQ(map->points.size(), 5U);
    EXPECT_EQ(run({"--live", "--socket", daemon.path(), "--seconds", "0.5"}).exit_code, 2) << "it is there already";
}

} // namespace
} // namespace locus
