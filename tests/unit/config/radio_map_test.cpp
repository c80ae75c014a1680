// Radio maps survive their file, and a file that is wrong is told so in sentences.
#include "config/load.h"
#include "config/radio_map.h"
#include "fusion/estimators/radio_particles.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <fstream>

namespace locus::config {
namespace {

constexpr std::string_view small_map = R"(site: hall
date: 2026-11-23
device: xbee
points:
  - {position_site_m: [0, 0, 1], heard: [[0x10, -50.5, 2, 9], [0x11, -71]]}
  - {position_site_m: [4, 0, 1], heard: [[0x10, -60.5, 2, 9]]}
  - {position_site_m: [0, 4, 1], heard: [[0x10, -62.5, 2, 9]]}
)";

std::string first_problem(std::string_view text) {
    Problems problems("map.yaml");
    const auto map = parse_radio_map(text, problems);
    EXPECT_EQ(map.has_value(), problems.empty());
    return problems.empty() ? "" : to_string(problems.take().front());
}

std::string with(std::string_view old_text, std::string_view new_text) {
    std::string text(small_map);
    return text.replace(text.find(old_text), old_text.size(), new_text);
}

radio::RadioMap any_map() {
    radio::RadioMap map{"hall \"1\"", "2026", "x", {}};
    const auto points = *rc::gen::inRange<std::size_t>(3, 6);
    for (std::size_t i = 0; i < points; ++i) {
        auto& point = map.points.emplace_back();
        point.position_site_m = {static_cast<double>(*rc::gen::inRange(-9999, 9999)) / 8, 0.5, 1.25};
        for (std::uint64_t b = 0; b < 3; ++b)
            point.heard.push_back({address(b * 0x123456789ab), static_cast<double>(-*rc::gen::inRange(200, 1000)) / 10,
                                   static_cast<double>(*rc::gen::inRange(0, 90)) / 10, *rc::gen::inRange(1, 999)});
    }
    return map;
}

TEST(RadioMapFile, ReadsBackWhatWasWritten) {
    EXPECT_TRUE(rc::check([] {
        const std::string written = radio_map_yaml(any_map());
        Problems problems("map.yaml");
        const auto again = parse_radio_map(written, problems);
        RC_ASSERT(again.has_value());
        RC_ASSERT(radio_map_yaml(again.value()) == written);
    }));
}

TEST(RadioMapFile, SaysWhatIsWrong) {
    EXPECT_EQ(first_problem(small_map), "");
    EXPECT_EQ(first_problem(with("-50.5", "-500")),
              "map.yaml:5:49: mean_dbm is -500; it must be between -150 dBm and 30 dBm");
    EXPECT_NE(first_problem(with("[0x11, -71]", "[0x10, -71]")).find("beacon 16 stands here twice"), std::string::npos);
    EXPECT_NE(first_problem(with("[0x11, -71]", "[0x11]")).find("a strength must be a list"), std::string::npos);
    EXPECT_NE(first_problem(with("device", "devise")).find("device"), std::string::npos);
    EXPECT_NE(first_problem(with("[0, 0, 1]", "[0, 1]")).find("position_site_m"), std::string::npos);
    EXPECT_NE(first_problem("site: hall").find("at least 3 points"), std::string::npos);
    EXPECT_NE(first_problem(with("[0x10, -62.5, 2, 9]", "")).find("no beacon was heard"), std::string::npos);
    EXPECT_NE(first_problem("points: [[[[[[[[[[[[[[[[[[[[[[[").find("map.yaml"), std::string::npos);
}

TEST(RadioMapFile, IsReplacedWhole) {
    const test::TemporaryFolder folder;
    const std::string path = folder / "map.yaml";
    Problems problems("map.yaml");
    const auto map = parse_radio_map(small_map, problems);
    ASSERT_TRUE(map.has_value());
    write_radio_map(path, map.value());
    write_radio_map(path, map.value());
    std::vector<ConfigProblem> found;
    const auto again = load_radio_map(path, found);
    ASSERT_TRUE(again.has_value());
    EXPECT_EQ(radio_map_yaml(again.value()), radio_map_yaml(map.value()));
    EXPECT_FALSE(std::filesystem::exists(path + ".new"));
    EXPECT_THROW(write_radio_map(folder / "none/map.yaml", map.value()), std::runtime_error);
}

TEST(RadioMapFile, IsReadBesideTheSettings) {
    const test::TemporaryFolder folder;
    const std::string settings = folder / "locusd.yaml";
    std::ofstream{settings} << "site: {name: hall}\nestimators: {radio_particles: {map: hall-map.yaml}}\n";
    const LoadResult without = load_settings(settings);
    ASSERT_FALSE(without.settings.has_value());
    EXPECT_NE(to_string(without.problems.front()).find("hall-map.yaml: there is no such file"), std::string::npos);
    std::ofstream(folder / "hall-map.yaml") << small_map;
    const LoadResult with_map = load_settings(settings);
    ASSERT_TRUE(with_map.settings.has_value());
    const auto& estimators = with_map.settings.value().engine.estimators;
    const auto found = std::ranges::find_if(
        estimators, [](const EstimatorSettings& each) { return each.row->name == radio_particles_row.name; });
    ASSERT_NE(found, estimators.end());
    EXPECT_EQ(static_cast<const RadioParticlesSettings*>(found->settings.get())->radio_map->points.size(), 3u);
}

} // namespace
} // namespace locus::config
