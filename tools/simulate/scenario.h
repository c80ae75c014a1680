// What a scenario file says: a site, walls that shadow, targets that move, sensors that measure them. Each part is a
// plain struct with its option table, as everywhere in the house, so the file is checked like a configuration.
#pragma once

#include "config/load.h"

#include <optional>
#include <string>
#include <vector>

namespace locus::simulate {

struct SimulationSettings {
    std::int64_t seed = 1;
    double duration_s = 0;
};

inline constexpr std::array simulation_options{
    option<&SimulationSettings::seed>("seed", "", 0, 2147483647, "Same seed, same bytes."),
    option<&SimulationSettings::duration_s>("duration_s", "s", 0, 1e6, "Simulated time; 0: until stopped."),
};

/// A vertical rectangle that radio passes late, or not at all.
struct Wall {
    Vec3 from_site_m{};
    Vec3 to_site_m{};
    double bias_min_m = 0.3;
    double bias_max_m = 1.5;
    double loss = 0;
};

inline constexpr std::array wall_options{
    option<&Wall::from_site_m>("from_site_m", "m", -1e5, 1e5, "One lower corner: [x, y, z].", {}, true),
    option<&Wall::to_site_m>("to_site_m", "m", -1e5, 1e5, "The upper corner at its other end: [x, y, z].", {}, true),
    option<&Wall::bias_min_m>("bias_min_m", "m", 0, 100, "Least that it adds to a distance measured through it."),
    option<&Wall::bias_max_m>("bias_max_m", "m", 0, 100, "Most that it adds; drawn anew when a link gets shadowed."),
    option<&Wall::loss>("loss", "", 0, 1, "Chance that a measurement through it is lost."),
};

inline constexpr std::array<std::string_view, 2> path_names{"waypoints", "figure_of_eight"};

/// How a target moves. Its waypoints stand in a list of their own.
struct Motion {
    std::string path = "waypoints";
    double speed_mps = 1;
    double corner_m = 0.5;
    double sway_m = 0;
    double start_m = 0;
    Vec3 center_site_m{};
    Vec3 size_m{10, 5, 0};
    std::vector<Vec3> waypoints_site_m;
};

inline constexpr std::array motion_options{
    option<&Motion::path>("path", "Round its waypoints_site_m, or a figure of eight.", path_names),
    option<&Motion::speed_mps>("speed_mps", "m/s", 0, 100, "Speed along the path."),
    option<&Motion::corner_m>("corner_m", "m", 0, 1000, "Waypoints are rounded over this length of either side."),
    option<&Motion::sway_m>("sway_m", "m", 0, 1, "A walker's: amplitude of the body's sway with each step."),
    option<&Motion::start_m>("start_m", "m", 0, 1e6, "How far along the path it begins."),
    option<&Motion::center_site_m>("center_site_m", "m", -1e5, 1e5, "Where the eight crosses itself."),
    option<&Motion::size_m>("size_m", "m", 0, 1e5, "Size of the eight in x, y and z."),
};

struct Mover {
    TargetSettings target;
    Motion motion;
};

inline constexpr std::array<std::string_view, 2> mode_names{"ranges", "range_differences"};

struct Radio {
    std::string mode = "ranges";
    double rate_hz = 10;
    double sigma_m = 0.1;
    double reach_m = 100;
    double loss = 0;
    double clock_drift_ppm = 0;
};

inline constexpr std::array radio_options{
    option<&Radio::mode>("mode", "Two-way ranges, or range differences between neighbours in the list of anchors.",
                         mode_names),
    option<&Radio::rate_hz>("rate_hz", "Hz", 0.01, 1000, "Measurements of each target per second."),
    option<&Radio::sigma_m>("sigma_m", "m", 0, 100, "Standard deviation of one measurement."),
    option<&Radio::reach_m>("reach_m", "m", 0, 1e5, "Anchors farther away are not heard."),
    option<&Radio::loss>("loss", "", 0, 1, "Chance that a measurement is lost."),
    option<&Radio::clock_drift_ppm>("clock_drift_ppm", "ppm", -1000, 1000,
                                    "How much the device's clock, and so its rate, runs fast."),
};

/// `input` is what the daemon's configuration says of it: transport, decoder, delay.
struct Sensor {
    InputSettings input;
    Radio radio;
};

struct Scenario {
    SimulationSettings simulation;
    Site site;
    std::vector<Wall> walls;
    std::vector<Mover> movers;
    std::vector<Sensor> sensors;
};

/// Every problem is found in one go; with any there is no scenario.
struct ScenarioResult {
    std::optional<Scenario> scenario;
    std::vector<ConfigProblem> problems;
};

ScenarioResult load_scenario(const std::string& path);
ScenarioResult load_scenario_text(std::string_view yaml, const std::string& file_name);

/// The daemon's configuration that listens to this scenario's sensors: site, targets, inputs; `socket` when not empty.
std::string print_configuration(const Scenario& scenario, const std::string& socket);

/// The reference page (Markdown) of everything a scenario file can say.
std::string scenario_page();

} // namespace locus::simulate
