// What must hold of every option table, whoever wrote it.
#include "config/section.h"
#include "config/value.h"
#include "drivers/decoder.h"
#include "drivers/transport/transport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <regex>
#include <set>

namespace locus {
namespace {

using Visit = std::function<void(std::string_view table, const OptionRow& row, const void* defaults)>;

void for_each_module(const auto& table, const Visit& visit) {
    for (const auto& module : table) {
        const auto defaults = module.options.make();
        for (const auto& row : module.options.rows) visit(module.name, row, defaults.get());
        for (const auto& list : module.options.lists) {
            const void* const item = list.append(defaults.get());
            for (const auto& row : list.rows) visit(list.name, row, item);
        }
    }
}

void for_each_row(const Visit& visit) {
    const auto plain = [&](std::string_view name, Options rows, const auto& defaults) {
        for (const auto& row : rows) visit(name, row, &defaults);
    };
    plain("site", site_options, Site{});
    plain("anchor", anchor_options, Anchor{});
    plain("wall", wall_options, Wall{});
    plain("origin", origin_options, Wgs84Anchor{});
    plain("target", target_options, TargetSettings{});
    plain("input", input_options, InputSettings{});
    plain("camera", camera_input_options, CameraInputSettings{});
    plain("camera that hangs", onlooker_options, CameraInputSettings{});
    plain("camera that is worn", camera::odometer_options, camera::OdometerSettings{});
    plain("tracker", vision::tracker_options, vision::TrackerSettings{});
    Settings settings;
    for (const auto& section : config::flat_sections())
        for (const auto& row : section.rows) visit(section.name, row, section.settings(settings));
    for_each_module(transport_table(), visit);
    for_each_module(decoder_table(), visit);
    for_each_module(camera::frame_source_table(), visit);
    for_each_module(camera::detector_table(), visit);
    for_each_module(estimator_table(), visit);
}

TEST(Tables, NamesAreSmallLettersAndAboutIsASentence) {
    for_each_row([](std::string_view table, const OptionRow& row, const void*) {
        EXPECT_TRUE(std::regex_match(std::string(row.name), std::regex("[a-z][a-z0-9_]*"))) << table << "." << row.name;
        EXPECT_TRUE(row.about.ends_with('.') || row.about.ends_with("...")) << table << "." << row.name;
        EXPECT_LE(row.minimum, row.maximum) << table << "." << row.name;
    });
}

TEST(Tables, NumbersThatHaveAUnitSayItInTheirName) {
    for_each_row([](std::string_view table, const OptionRow& row, const void*) {
        const bool plain_unit = std::regex_match(std::string(row.unit), std::regex("m|s|Hz|deg|Bd"));
        if (!plain_unit) return;
        std::string ending = "_" + std::string(row.unit);
        for (char& c : ending) c = static_cast<char>(std::tolower(c));
        EXPECT_TRUE(row.name.ends_with(ending)) << table << "." << row.name;
    });
}

TEST(Tables, EveryDefaultMayBeTypedIn) {
    for_each_row([](std::string_view table, const OptionRow& row, const void* defaults) {
        const auto shape = row.get(defaults);
        const auto yaml = config::to_yaml(shape);
        if (row.required || yaml.empty() || yaml == "\"\"") return;
        config::Problems problems("defaults");
        const auto node = config::parse_yaml(yaml, problems);
        ASSERT_TRUE(node);
        EXPECT_EQ(config::read_value(*node, row, shape, problems), shape) << table << "." << row.name;
    });
}

TEST(Tables, OptionsOfAnInputNeverShareAName) {
    for (const auto& transport : transport_table())
        for (const auto& decoder : decoder_table()) {
            std::set<std::string_view> names;
            for (const Options rows : {Options(input_options), transport.options.rows, decoder.options.rows})
                for (const auto& row : rows)
                    EXPECT_TRUE(names.insert(row.name).second)
                        << transport.name << " + " << decoder.name << ": " << row.name;
        }
}

TEST(Tables, NamesOfModulesAreTheirOwn) {
    const auto unique = [](const auto& table) {
        std::set<std::string_view> names;
        for (const auto& row : table) EXPECT_TRUE(names.insert(row.name).second) << row.name;
    };
    unique(transport_table());
    unique(decoder_table());
    unique(estimator_table());
}

TEST(Tables, OfOneCameraShareNoKey) {
    for (const auto& source : camera::frame_source_table())
        for (const auto& detector : camera::detector_table()) {
            std::set<std::string_view> keys;
            for (const Options rows : {Options(camera_input_options), Options(onlooker_options), source.options.rows,
                                       detector.options.rows, Options(vision::tracker_options)})
                for (const auto& row : rows)
                    EXPECT_TRUE(keys.insert(row.name).second)
                        << source.name << ", " << detector.name << ": " << row.name;
        }
}

TEST(Tables, OfOneWornCameraShareNoKey) {
    for (const auto& source : camera::frame_source_table()) {
        std::set<std::string_view> keys;
        for (const Options rows :
             {Options(camera_input_options), source.options.rows, Options(camera::odometer_options)})
            for (const auto& row : rows) EXPECT_TRUE(keys.insert(row.name).second) << source.name << ": " << row.name;
    }
}

} // namespace
} // namespace locus
