// Key frames that ORB-SLAM wrote (evo_trajectories, fr2_desk), as they stand in its file, and a tag's lines beside them
// in one raw recording, or the file imported beside a recording of ranges: through the replay to the scale. The ranges
// are simulated (slam_paths.h).
#include "config/load.h"
#include "drivers/recording/log_line.h"
#include "drivers/recording/measurement_json.h"
#include "drivers/uwb/trek1000.h"
#include "tests/replay/slam_paths.h"
#include "tests/support/temporary_folder.h"
#include "tools/import/import.h"
#include "tools/replay/replay.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>

namespace locus::slam {
namespace {

constexpr double log_begin_s = 100; // of slam_paths.h
constexpr double bridged_gap_s = 0.1, noise_m = 0.1;

using LogLines = std::multimap<Timestamp, std::string>;

void append_to_log(LogLines& log, const std::string& input, double time_s, const std::string& text) {
    Packet packet;
    packet.time = timestamp_from_s(log_begin_s + time_s);
    packet.data = {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
    log.emplace(packet.time, to_log_line(input, packet));
}

/// The file's own lines, each when it was so late by its own stamp.
void append_key_frames(LogLines& log, const std::filesystem::path& file) {
    std::ifstream lines(file);
    std::optional<double> begin_s;
    for (std::string line; std::getline(lines, line);) {
        const double stamp_s = std::stod(line);
        if (!begin_s) begin_s = stamp_s;
        append_to_log(log, "slam", stamp_s - *begin_s, line + "\n");
    }
}

/// What was heard in one sweep over the anchors is one line.
void append_sweeps(LogLines& log, const std::vector<Measurement>& ranges) {
    std::map<Timestamp, uwb::TrekReport> reports;
    for (const Measurement& measurement : ranges) {
        const auto& range = std::get<Range>(measurement.observation);
        uwb::TrekReport& report = reports[measurement.time];
        report.tag = static_cast<std::uint16_t>(number(tag_address));
        report.mask |= 1u << number(range.anchor);
        report.range_mm[number(range.anchor)] = static_cast<std::int32_t>(std::lround(1e3 * range.range_m));
    }
    for (const auto& [time, report] : reports) append_to_log(log, "tag", to_s(time) - log_begin_s, encode(report));
}

std::string configuration_of(const Site& site) {
    std::string text = "site:\n  anchors:\n";
    for (const Anchor& anchor : site.anchors)
        text += fmt::format("    - {{name: A{0}, address: {0}, position_site_m: [{1}]}}\n", number(anchor.address),
                            fmt::join(anchor.position_site_m, ", "));
    return text +
           fmt::format("inputs:\n"
                       "  - {{name: tag, transport: pty, path: /dev/null, decoder: trek1000}}\n"
                       "  - {{name: slam, transport: tcp, host: 127.0.0.1, port: 4100, decoder: tum, tag: {0}}}\n"
                       "targets: [{{name: walker, address: {0}, estimator: visual_scale}}]\n",
                       number(tag_address));
}

class SlamReplay : public testing::Test {
  protected:
    void SetUp() override {
        const auto found = recording("fr2_desk_ORB_kf_mono.txt", "fr2_desk_groundtruth.txt");
        if (!found) GTEST_SKIP() << "evo_trajectories is not there";
        desk_ = found.value();
        key_frames_ = test::recorded("evo_trajectories").value() / "fr2_desk_ORB_kf_mono.txt";
        site_ = room(desk_.truth);
        ranges_ = ranges(desk_, site_, noise_m, 1, bridged_gap_s);
    }

    void expect_scale(const std::string& recording) const {
        std::ofstream(folder_ / "desk.yaml") << configuration_of(site_);
        const auto loaded = load_settings(folder_ / "desk.yaml");
        ASSERT_TRUE(loaded.settings.has_value()) << to_string(loaded.problems.front());
        const std::string said = folder_ / "poses.jsonl";
        const auto summary = replay::replay(loaded.settings.value(), {recording, {said}, "", false, false});
        EXPECT_EQ(summary.read.bad_lines, 0u);
        EXPECT_EQ(summary.read.refused, decltype(summary.read.refused){});

        std::ifstream poses(said);
        nlohmann::json last;
        for (std::string line; std::getline(poses, line);) last = nlohmann::json::parse(line)["odometry_scale"];
        ASSERT_TRUE(last.contains("metres_per_unit")) << last;
        const double truth = scale_to_truth(desk_, -1, 1e9, bridged_gap_s);
        std::printf("fr2_desk: %.4f m a unit, sigma %.2f %%; motion capture says %.4f\n",
                    last["metres_per_unit"].get<double>(), 100 * last["relative_sigma"].get<double>(), truth);
        EXPECT_NEAR(last["metres_per_unit"].get<double>() / truth, 1, 0.01);
    }

    test::TemporaryFolder folder_;
    Recording desk_;
    std::filesystem::path key_frames_;
    Site site_;
    std::vector<Measurement> ranges_;
};

TEST_F(SlamReplay, LinesOfAFileAndOfATagTellTheScale) {
    LogLines log;
    append_key_frames(log, key_frames_);
    append_sweeps(log, ranges_);
    std::ofstream file(folder_ / "desk.log");
    for (const auto& [time, line] : log) file << line << '\n';
    file.close();
    expect_scale(folder_ / "desk.log");
}

TEST_F(SlamReplay, AnImportedFileBesideARecordingTellsTheScale) {
    std::ofstream file(folder_ / "ranges.jsonl");
    for (const Measurement& measurement : ranges_) file << to_json_line(measurement) << '\n';
    file.close();
    importing::Request request{{folder_ / "ranges.jsonl", key_frames_.string()}, folder_ / "both.jsonl", tag_address};
    std::ifstream first_line(key_frames_);
    double begin_s = 0;
    first_line >> begin_s;
    request.poses_shift_s = log_begin_s - begin_s;
    const auto reports = importing::import_files(request);
    EXPECT_EQ(reports[1].given.at("VISUAL_ODOMETRY"), desk_.key_frames.size());
    expect_scale(folder_ / "both.jsonl");
}

} // namespace
} // namespace locus::slam
