#include "tests/support/source_folder.h"
#include "tools/simulate/scenario.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace locus::simulate {
namespace {

using ::testing::HasSubstr;

const std::string good = R"(simulation: {seed: 5, duration_s: 2}
site:
  anchors:
    - {name: A0, address: 0x8000, position_site_m: [0, 0, 3]}
    - {name: A1, address: 0x8001, position_site_m: [9, 0, 3]}
walls:
  - {from_site_m: [3, 0, 0], to_site_m: [3, 2, 2]}
targets:
  - {name: one, address: 4, speed_mps: 2, waypoints_site_m: [[0, 0, 1], [9, 9, 1]]}
sensors:
  - {name: uwb, transport: pty, path: uwb.pty, decoder: trek1000, anchor_offset: 0x8000, rate_hz: 5, delay_s: 0.02}
)";

/// All problems, one a line.
std::string problems_of(const std::string& yaml) {
    std::string text;
    const auto result = load_scenario_text(yaml, "s.yaml");
    EXPECT_EQ(result.scenario.has_value(), result.problems.empty());
    for (const ConfigProblem& problem : result.problems) text += to_string(problem) + "\n";
    return text;
}

std::string with(const std::string& what, const std::string& instead) {
    std::string yaml = good;
    yaml.replace(yaml.find(what), what.size(), instead);
    return yaml;
}

TEST(LoadScenario, ReadsEveryPart) {
    const auto result = load_scenario_text(good, "s.yaml");
    ASSERT_TRUE(result.scenario) << problems_of(good);
    const Scenario& scenario = *result.scenario;
    EXPECT_EQ(scenario.simulation.seed, 5);
    EXPECT_EQ(scenario.simulation.duration_s, 2);
    EXPECT_EQ(scenario.site.anchors.at(1).address, address(0x8001));
    EXPECT_EQ(scenario.walls.at(0).to_site_m, (Vec3{3, 2, 2}));
    EXPECT_EQ(scenario.movers.at(0).target.address, address(4));
    EXPECT_EQ(scenario.movers.at(0).motion.speed_mps, 2);
    EXPECT_EQ(scenario.movers.at(0).motion.waypoints_site_m.at(1), (Vec3{9, 9, 1}));
    EXPECT_EQ(scenario.sensors.at(0).radio.rate_hz, 5);
    EXPECT_EQ(scenario.sensors.at(0).input.delay_s, 0.02);
    EXPECT_EQ(scenario.sensors.at(0).input.decoder->name, "trek1000");
}

TEST(LoadScenario, SaysWhereAndWhat) {
    EXPECT_THAT(problems_of(with("rate_hz", "rate")), HasSubstr("s.yaml:11:"));
    EXPECT_THAT(problems_of(with("rate_hz", "rate")), HasSubstr("rate_hz"));
    EXPECT_THAT(problems_of(with("rate_hz: 5", "rate_hz: fast")), HasSubstr("rate_hz must be a number"));
    EXPECT_THAT(problems_of(with("speed_mps: 2", "speed_mps: -2")), HasSubstr("s.yaml:9:"));
    EXPECT_THAT(problems_of(with("[9, 9, 1]", "[9, 9]")), HasSubstr("waypoint must be"));
    EXPECT_THAT(problems_of(with("waypoints_site_m", "way_points")), HasSubstr("waypoints_site_m"));
    EXPECT_THAT(problems_of(with("[3, 2, 2]}", "[3, 2, 2], bias_max_m: 0.1}")), HasSubstr("less than bias_min_m"));
    EXPECT_THAT(problems_of(with("walls:", "wals:")), HasSubstr("walls"));
    EXPECT_THAT(problems_of(""), HasSubstr("no targets"));
}

TEST(LoadScenario, SaysWhatCannotBeSimulated) {
    EXPECT_THAT(problems_of(with("pty, path: uwb.pty", "recording, path: a.log")), HasSubstr("use pty, fifo or can"));
    EXPECT_THAT(problems_of(with("decoder: trek1000", "decoder: dw1000_can")), HasSubstr("s.yaml:11:"));
    EXPECT_THAT(problems_of(with("rate_hz", "mode: range_differences, rate_hz")), HasSubstr("ranges only"));
    EXPECT_THAT(problems_of(with("anchor_offset: 0x8000", "anchor_offset: 0")), HasSubstr("must be below 16"));
    EXPECT_THAT(problems_of(with("address: 4", "address: 70000")), HasSubstr("must be below 65536"));
}

TEST(LoadScenario, RefusesDoubleNames) {
    const std::string twice = "targets:\n  - {name: one, address: 5, waypoints_site_m: [[0, 0, 0]]}";
    EXPECT_THAT(problems_of(with("targets:", twice)), HasSubstr("a second target with the name one"));
}

TEST(LoadScenario, MissingFileIsASentence) {
    const auto result = load_scenario("/nowhere/at/all.yaml");
    ASSERT_EQ(result.problems.size(), 1u);
    EXPECT_THAT(to_string(result.problems[0]), HasSubstr("/nowhere/at/all.yaml"));
}

TEST(PrintConfiguration, IsWhatTheDaemonLoads) {
    const auto text = print_configuration(*load_scenario_text(good, "s.yaml").scenario, "/tmp/a.sock");
    const auto loaded = load_settings_text(text, "printed");
    ASSERT_TRUE(loaded.settings) << text << to_string(loaded.problems.at(0));
    EXPECT_EQ(loaded.settings->engine.site.anchors.size(), 2u);
    EXPECT_EQ(loaded.settings->engine.targets.at(0).name, "one");
    EXPECT_EQ(loaded.settings->inputs.at(0).name, "uwb");
    EXPECT_EQ(loaded.settings->inputs.at(0).delay_s, 0.02);
    EXPECT_EQ(loaded.settings->publish.socket, "/tmp/a.sock");
}

TEST(ScenarioPage, IsTheOneInDocs) {
    std::ifstream file(test::source_folder() + "/docs/scenario.md");
    const std::string page{std::istreambuf_iterator<char>(file), {}};
    EXPECT_TRUE(page == scenario_page()) << "write it anew: locus simulate --reference > docs/scenario.md";
}

TEST(Examples, ScenariosLoadAndGiveConfigurations) {
    for (const char* name : {"demo-scenario.yaml", "can-scenario.yaml"}) {
        const auto result = load_scenario(test::source_folder() + "/config/examples/" + name);
        ASSERT_TRUE(result.scenario) << name << to_string(result.problems.at(0));
        EXPECT_TRUE(load_settings_text(print_configuration(*result.scenario, ""), name).settings);
    }
}

} // namespace
} // namespace locus::simulate
