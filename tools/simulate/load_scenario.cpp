// A scenario file, read by the configuration's own reader: the same checks, the same errors with line and column.
#include "config/address.h"
#include "config/file_text.h"
#include "config/names.h"
#include "config/section.h"
#include "config/uniques.h"
#include "config/value.h"
#include "tools/simulate/frame_writer.h"
#include "tools/simulate/output.h"
#include "tools/simulate/scenario.h"

#include <algorithm>

namespace locus::simulate {
namespace {

using namespace locus::config;

constexpr std::array<std::string_view, 5> section_names{"simulation", "site", "walls", "targets", "sensors"};
constexpr std::size_t max_walls = 1000;
constexpr std::size_t max_movers = 1000;
constexpr std::size_t max_waypoints = 1000;
constexpr std::size_t max_sensors = 64;

constexpr OptionRow waypoint_row{"waypoint",
                                 "m",
                                 -1e5,
                                 1e5,
                                 "A point of the path: [x, y, z].",
                                 {},
                                 false,
                                 [](const void*) -> OptionValue { return Vec3{}; },
                                 nullptr};

/// An absent section reads like an empty one.
const YamlNode& section(const YamlNode& root, std::string_view name) {
    static const YamlNode absent;
    const YamlNode* const found = root.find(name);
    return found != nullptr ? *found : absent;
}

void read_walls(const YamlNode& node, std::vector<Wall>& walls, Problems& problems) {
    for (const YamlNode& item : list_items(node, max_walls, problems)) {
        Wall& wall = walls.emplace_back();
        const BoundOptions table[]{{wall_options, &wall}};
        read_map(item, {"wall"}, table, problems);
        if (wall.bias_max_m < wall.bias_min_m) problems.add(item.mark, "bias_max_m is less than bias_min_m");
    }
}

void read_waypoints(const YamlNode& mover, Motion& motion, Problems& problems) {
    const YamlNode& list = section(mover, "waypoints_site_m");
    for (const YamlNode& item : list_items(list, max_waypoints, problems))
        if (const auto point = read_value(item, waypoint_row, Vec3{}, problems))
            motion.waypoints_site_m.push_back(std::get<Vec3>(*point));
    if (motion.path == "waypoints" && list.children.empty())
        problems.add(mover.mark, "the target has no waypoints_site_m, and its path is not figure_of_eight");
}

void read_movers(const YamlNode& node, std::vector<Mover>& movers, Problems& problems) {
    static constexpr std::string_view other_keys[]{"waypoints_site_m"};
    Uniques names("target with the name"), addresses("target with the address");
    for (const YamlNode& item : list_items(node, max_movers, problems)) {
        Mover& mover = movers.emplace_back();
        const BoundOptions tables[]{{target_options, &mover.target}, {motion_options, &mover.motion}};
        if (!read_map(item, {"target", other_keys}, tables, problems)) continue;
        read_waypoints(item, mover.motion, problems);
        names.check(mover.target.name, item.mark, problems);
        addresses.check(to_text(mover.target.address), item.mark, problems);
    }
}

/// What the simulator itself cannot do with a sensor that the daemon would take.
void check_sensor(const YamlNode& item, const Scenario& scenario, const Sensor& sensor, Problems& problems) {
    const InputSettings& input = sensor.input;
    if (input.transport == nullptr || input.decoder == nullptr) return;
    std::string sentence = cannot_open(input);
    if (sentence.empty()) sentence = cannot_write(scenario, sensor);
    if (!sentence.empty()) problems.add(item.mark, std::move(sentence));
}

void read_sensors(const YamlNode& node, Scenario& scenario, Problems& problems) {
    Uniques names("sensor with the name");
    for (const YamlNode& item : list_items(node, max_sensors, problems)) {
        Sensor& sensor = scenario.sensors.emplace_back();
        const BoundOptions radio[]{{radio_options, &sensor.radio}};
        read_input(item, sensor.input, radio, problems);
        names.check(sensor.input.name, item.mark, problems);
        check_sensor(item, scenario, sensor, problems);
    }
}

Scenario read_scenario(const YamlNode& root, Problems& problems) {
    Scenario scenario;
    if (!read_map(root, {"the file", section_names}, {}, problems)) return scenario;
    const BoundOptions simulation[]{{simulation_options, &scenario.simulation}};
    read_map(section(root, "simulation"), {"simulation"}, simulation, problems);
    read_site(section(root, "site"), scenario.site, problems);
    read_walls(section(root, "walls"), scenario.walls, problems);
    read_movers(section(root, "targets"), scenario.movers, problems);
    read_sensors(section(root, "sensors"), scenario, problems);
    if (scenario.movers.empty()) problems.add({}, "the scenario has no targets");
    if (scenario.sensors.empty()) problems.add({}, "the scenario has no sensors");
    return scenario;
}

} // namespace

ScenarioResult load_scenario_text(std::string_view yaml, const std::string& file_name) {
    Problems problems(file_name);
    ScenarioResult result;
    if (const auto root = parse_yaml(yaml, problems)) {
        Scenario scenario = read_scenario(*root, problems);
        if (problems.empty()) result.scenario = std::move(scenario);
    }
    result.problems = problems.take();
    return result;
}

ScenarioResult load_scenario(const std::string& path) {
    std::string error;
    if (const auto text = read_file(path, error)) return load_scenario_text(*text, path);
    ScenarioResult result;
    result.problems.push_back({path, 0, 0, error});
    return result;
}

std::string print_configuration(const Scenario& scenario, const std::string& socket) {
    std::vector<TargetSettings> targets;
    for (const Mover& mover : scenario.movers) targets.push_back(mover.target);
    std::vector<InputSettings> inputs;
    for (const Sensor& sensor : scenario.sensors) inputs.push_back(sensor.input);
    std::string text = print_site(scenario.site) + print_targets(targets) + print_inputs(inputs);
    if (!socket.empty()) text += "publish:\n  socket: " + to_yaml(socket) + "\n";
    return text;
}

} // namespace locus::simulate
