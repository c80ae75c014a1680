// Paper 004, "Research on Group Location Technology of Indoor Dual-Source Combination", rebuilt: three people a metre
// apart, inertial units at the waist, two laps around a rectangle of 50 m x 60 m, UWB ranges between them and to five
// anchors. The paper shows two drawings and no figures; these are ours, seeded. Units are of a consumer's kind
// (gyroscope 0.015 deg/s per root Hz, bias 0.6 deg/s, accelerometer 200 ug per root Hz), ranges of 10 cm come at 5 Hz,
// and every minute and a half there are 20 s in which 7 of 10 paths to anchors, drawn for each person, are 0.5 to 2 m
// longer. The table is in docs/papers.md.
#include "fusion/estimators/walker_particles.h"
#include "tests/unit/fusion/inertial/simulated_team.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace locus;
using namespace locus::test;

constexpr double width_m = 50, depth_m = 60, turn_s = 2;
constexpr double blocked_share = 0.7; // of the paths, in the stretches behind walls
constexpr unsigned teams = 5;

struct Method {
    const char* name;
    std::string estimator;
    bool units;
    bool peers;
    bool anchors_after_start;
    bool third_is_clear; ///< else walls are in all three's way alike
};

EngineSettings gymnasium(const Method& method) {
    EngineSettings settings;
    settings.fusion.estimator = method.estimator;
    settings.fusion.max_targets = team_size;
    settings.fusion.rate_hz = 50;
    settings.fusion.lost_after_s = 3600;
    const Vec3 places[]{{-5, -5, 1.2}, {55, -5, 1.2}, {55, 65, 1.2}, {-5, 65, 1.2}, {25, 30, 1.2}};
    for (const Vec3& place : places)
        settings.site.anchors.push_back({"", address(settings.site.anchors.size()), place});
    if (method.estimator == "range_ekf") {
        auto planar = std::make_shared<RangeEkfSettings>();
        planar->planar = true;
        planar->height_m = 1.2;
        settings.estimators.push_back({find_estimator("range_ekf"), planar});
    }
    return settings;
}

/// Blocked in the middle of the long sides.
bool behind_walls(double walked_s) { return std::fmod(walked_s, 90) > 55 && std::fmod(walked_s, 90) < 75; }

struct Errors {
    double squares = 0, worst = 0, end = 0;
    int count = 0;
    double rmse() const { return std::sqrt(squares / count); }
    void add(double error_m) {
        squares += error_m * error_m;
        worst = std::max(worst, error_m);
        ++count;
    }
};

/// Stands for five seconds, then walks two laps: sides at 1.3 m/s, quarter turns in two seconds.
Errors two_laps(const Method& method, unsigned seed) {
    TeamModel model;
    model.walker.rate_hz = 50;
    model.units = method.units;
    model.peers = method.peers;
    SimulatedTeam team(gymnasium(method), model, seed, {{{0, 0}, {0, -1}, {-1, 0}}}, 0);
    const double start_s = team.time_s();
    std::mt19937 random(seed);
    std::array<std::array<double, team_size>, 5> excess_m{};
    std::uniform_real_distribution<> uniform;
    for (auto& anchor : excess_m)
        for (double& path : anchor) path = uniform(random) < blocked_share ? 0.5 + 1.5 * uniform(random) : 0;
    const Excess heard = [&](std::size_t anchor, std::size_t who) {
        const double walked_s = team.time_s() - start_s - 5;
        if (!method.anchors_after_start && walked_s > 10) return std::nan("");
        const bool clear_path = !behind_walls(walked_s) || (method.third_is_clear && who == 2);
        return clear_path ? 0 : excess_m[anchor][who];
    };
    Errors errors;
    const auto go = [&](double seconds, double turn_radps, bool walking) {
        for (int i = 0; i < std::lround(seconds * model.walker.rate_hz); ++i) {
            team.move({turn_radps, turn_radps, turn_radps}, walking, heard);
            if (walking && i % 10 == 0)
                for (std::size_t who = 0; who < team_size; ++who) errors.add(team.error_m(who).norm());
        }
    };
    go(5, 0, false);
    for (int side = 0; side < 8; ++side) {
        go((side % 2 == 0 ? width_m : depth_m) / model.walker.speed_mps - turn_s, 0, true);
        go(turn_s, 0.5 * std::numbers::pi / turn_s, true);
    }
    for (std::size_t who = 0; who < team_size; ++who) errors.end += team.error_m(who).norm() / team_size;
    return errors;
}

Errors measured(const Method& method) {
    Errors all;
    for (unsigned seed = 1; seed <= teams; ++seed) {
        const Errors one = two_laps(method, seed);
        all.squares += one.squares;
        all.count += one.count;
        all.worst = std::max(all.worst, one.worst);
        all.end += one.end / teams;
    }
    std::printf("| %s | %.2f | %.2f | %.2f |\n", method.name, all.rmse(), all.worst, all.end);
    return all;
}

TEST(Paper004, ATeamOfThreeTwiceRoundARectangle) {
    std::printf("| method | RMSE m | worst m | at the end m |\n|---|---|---|---|\n");
    const Errors imu = measured({"inertial unit alone", "walker_particles", true, false, false, false});
    const Errors ranges = measured({"range_ekf, ranges alone", "range_ekf", false, false, true, false});
    const Errors alone = measured({"walker_particles, no cooperation", "walker_particles", true, false, true, false});
    const Errors team = measured({"walker_particles, cooperation", "walker_particles", true, true, true, false});
    const Errors two_alone =
        measured({"third has clear paths, no cooperation", "walker_particles", true, false, true, true});
    const Errors two_led = measured({"third has clear paths, cooperation", "walker_particles", true, true, true, true});
    EXPECT_LT(alone.rmse(), 0.5 * imu.rmse()); // what the paper's figures 3 and 4 show
    EXPECT_LT(alone.rmse(), ranges.rmse());
    EXPECT_LT(team.rmse(), 1.05 * alone.rmse()); // where nobody knows more than another there is nothing to gain
    EXPECT_LT(two_led.rmse(), two_alone.rmse());
}

} // namespace
