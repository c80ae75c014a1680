// Walks with a phone through a mall (indoor_location_competition): converter, `locus survey` of two walks out of every
// three, `locus replay` of the third with radio_particles. Figures that this prints are in docs/accuracy.md.
#include "config/load.h"
#include "config/radio_map.h"
#include "fusion/radio/neighbours.h"
#include "tests/replay/data.h"
#include "tests/support/temporary_folder.h"
#include "tools/evaluate/read.h"
#include "tools/replay/replay.h"
#include "tools/survey/collect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numeric>

namespace locus {
namespace {

std::vector<std::string> listed(const std::string& path) {
    std::vector<std::string> names;
    std::ifstream file(path);
    for (std::string name; file >> name;) names.push_back(name);
    return names;
}

struct MallErrors {
    std::vector<double> all_m;
    void print(const char* what) {
        std::ranges::sort(all_m);
        std::printf("%-22s mean %.2f m, 80 %% %.2f m, most %.2f m (%zu)\n", what, mean_m(), at_m(0.8), all_m.back(),
                    all_m.size());
    }
    double mean_m() const {
        return std::accumulate(all_m.begin(), all_m.end(), 0.0) / static_cast<double>(all_m.size());
    }
    double at_m(double share) const {
        return all_m[static_cast<std::size_t>(share * static_cast<double>(all_m.size() - 1))];
    }
};

/// Ten times a second from the first pose on, and what part of the walk that is.
double add_errors(const std::string& stem, MallErrors& errors) {
    if (std::filesystem::file_size(stem + ".tum") == 0) return 0; // too short for a first position
    const auto truth = evaluate::read_truth(stem + ".truth.tum");
    const auto poses = evaluate::read_estimate(stem + ".tum");
    int with_pose = 0;
    for (const auto& point : truth) {
        const auto place = survey::place_at(poses, point.time_s);
        if (!place.has_value()) continue;
        ++with_pose;
        errors.all_m.push_back(std::hypot((*place)[0] - point.position_m.x(), (*place)[1] - point.position_m.y()));
    }
    return static_cast<double>(with_pose) / static_cast<double>(truth.size());
}

/// 4-NN of what was heard in the last two seconds, twice a second: the yardstick.
void add_neighbours(const std::string& stem, const radio::RadioMap& map, const Settings& settings, MallErrors& errors) {
    const auto truth = evaluate::read_truth(stem + ".truth.tum");
    std::map<Address, std::pair<double, double>> heard; // time, strength
    double next_s = truth.front().time_s + 2;
    const double floor_dbm = radio::hearing_floor_dbm(map);
    replay::read_recording(stem + ".jsonl", settings, [&](const Measurement& measurement, Timestamp) {
        const double now_s = to_s(measurement.time);
        if (const auto* strength = std::get_if<SignalStrength>(&measurement.observation))
            heard[strength->transmitter] = {now_s, double{strength->rssi_dbm}};
        if (now_s < next_s) return;
        next_s = now_s + 0.5;
        std::vector<radio::Reading> readings;
        for (const auto& [beacon, reading] : heard)
            if (now_s - reading.first < 2) readings.push_back({beacon, reading.second});
        const auto place = survey::place_at(truth, now_s);
        const auto found = radio::nearest_neighbours(map, readings, {4, false}, floor_dbm);
        if (place.has_value() && found.has_value())
            errors.all_m.push_back((*found - Eigen::Vector2d((*place)[0], (*place)[1])).norm());
    });
}

TEST(RadioWalks, StepsAndAMapFollowAPhoneThroughAMall) {
    const auto data = test::recorded("indoor_location_competition");
    if (!data) GTEST_SKIP() << "indoor_location_competition is not there";
    if (!std::getenv("LOCUS_ALL_FRAMES")) GTEST_SKIP() << "takes a minute: LOCUS_ALL_FRAMES=1 runs it";
    const test::TemporaryFolder folder;
    const std::string command = "python3 '" + test::source_folder() + "/tools/convert/indoor_location' '" +
                                data->string() + "' site2/F3 --out '" + folder.path() + "' > /dev/null";
    ASSERT_EQ(std::system(command.c_str()), 0) << command; // NOLINT(cert-env33-c,concurrency-mt-unsafe): one thread
    survey::Request request;
    for (const std::string& name : listed(folder / "map.list")) {
        request.recordings.push_back(folder / (name + ".jsonl"));
        request.poses.push_back(folder / (name + ".truth.tum"));
    }
    const survey::Collected collected = survey::collect(request, {});
    config::write_radio_map(folder / "map.yaml", collected.map);
    const LoadResult loaded = load_settings(folder / "site.yaml");
    ASSERT_TRUE(loaded.settings.has_value()) << to_string(loaded.problems.front());
    MallErrors ours, neighbours;
    double covered = 0;
    const auto names = listed(folder / "test.list");
    for (const std::string& name : names) {
        replay::replay(*loaded.settings, {folder / (name + ".jsonl"), {folder / (name + ".tum")}, "", false, false});
        const double share = add_errors(folder / name, ours);
        add_neighbours(folder / name, collected.map, *loaded.settings, neighbours);
        covered += share / static_cast<double>(names.size());
    }
    std::printf("map of %zu walks, %zu points, %zu beacons; %zu walks, %.0f %% of their time with a pose\n",
                request.recordings.size(), collected.map.points.size(), radio::beacons_of(collected.map).size(),
                names.size(), 100 * covered);
    neighbours.print("4-NN");
    ours.print("radio_particles");
    EXPECT_GT(covered, 0.7);
    EXPECT_LT(ours.mean_m(), neighbours.mean_m());
}

} // namespace
} // namespace locus
