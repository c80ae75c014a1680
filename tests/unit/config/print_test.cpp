// Whatever the settings, their print loads back to the same settings; the reference page is up to date.
#include "config/section.h"
#include "config/value.h"
#include "load_fixture.h"
#include "tests/support/source_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <numeric>

namespace locus {
namespace {

/// Any value that the loader would let through for the row.
struct AnyValue {
    const OptionRow& row;

    double number() const {
        const double minimum = std::max(row.minimum, -1e15);
        const double maximum = std::min(row.maximum, 1e15);
        const auto part = static_cast<double>(*rc::gen::arbitrary<std::uint32_t>()) / 0xFFFFFFFF;
        return std::clamp(minimum + part * (maximum - minimum), minimum, maximum);
    }

    OptionValue operator()(bool) const { return *rc::gen::arbitrary<bool>(); }
    OptionValue operator()(std::int64_t) const { return static_cast<std::int64_t>(number()); }
    OptionValue operator()(double) const { return number(); }
    OptionValue operator()(Address) const { return address(*rc::gen::arbitrary<std::uint32_t>()); }
    OptionValue operator()(const Vec3&) const { return Vec3{number(), number(), number()}; }
    OptionValue operator()(const std::string&) const {
        if (!row.choices.empty()) return std::string(*rc::gen::elementOf(row.choices));
        const auto odd = rc::gen::elementOf(std::string("\"\\'#:{}[]&*!|>%@`- "));
        return *rc::gen::nonEmpty(rc::gen::container<std::string>(rc::gen::oneOf(rc::gen::inRange(' ', '~'), odd)));
    }
};

void fill(Options rows, void* settings, bool others = true) {
    for (const auto& row : rows)
        if (row.required || (others && *rc::gen::arbitrary<bool>()))
            row.set(settings, std::visit(AnyValue{row}, row.get(settings)));
}

std::string any_name(std::size_t index) { return fmt::format("name-{}\xC3\xA9", index); }

/// 0, 1, ... fewer than `limit` of them.
std::vector<std::size_t> up_to(int limit) {
    std::vector<std::size_t> indices(static_cast<std::size_t>(*rc::gen::inRange(0, limit)));
    std::iota(indices.begin(), indices.end(), 0);
    return indices;
}

/// Any values; where those do not fit together, the defaults of all that may be left out.
std::shared_ptr<void> any_settings_of(const OptionTable& table) {
    auto settings = table.make();
    fill(table.rows, settings.get());
    if (!table.check || table.check(settings.get()).empty()) return settings;
    settings = table.make();
    fill(table.rows, settings.get(), false);
    return settings;
}

/// Some need more than rows (a layout's fields): those have tests of their own.
bool is_complete_by_default(const OptionTable& table) {
    return !table.check || table.check(table.make().get()).empty();
}

InputSettings any_input(std::size_t index) {
    InputSettings input;
    input.name = any_name(index);
    input.transport = &transport_table()[*rc::gen::inRange<std::size_t>(0, transport_table().size())];
    std::vector<const DecoderRow*> fitting;
    for (const auto& row : decoder_table())
        if (input.transport->carries(row.wire) && is_complete_by_default(row.options)) fitting.push_back(&row);
    RC_PRE(!fitting.empty());
    input.decoder = *rc::gen::elementOf(fitting);
    input.transport_settings = any_settings_of(input.transport->options);
    input.decoder_settings = any_settings_of(input.decoder->options);
    input.delay_s = *rc::gen::inRange(0, 1000) / 128.0;
    input.enabled = *rc::gen::arbitrary<bool>();
    return input;
}

CameraInputSettings any_camera(std::size_t index) {
    CameraInputSettings camera;
    fill(camera_input_options, &camera);
    camera.name = any_name(100 + index); // inputs have the others
    const auto sources = camera::frame_source_table();
    camera.source = &sources[*rc::gen::inRange<std::size_t>(0, sources.size())];
    camera.source_settings = any_settings_of(camera.source->options);
    if (*rc::gen::arbitrary<bool>()) {
        camera.worn_by = address(index);
        camera.calibration = "/etc/locusd/lens.yaml";
        fill(camera::odometer_options, &camera.odometry);
        return camera;
    }
    camera.worn_by = no_address;
    fill(onlooker_options, &camera);
    const auto detectors = camera::detector_table();
    camera.detector = &detectors[*rc::gen::inRange<std::size_t>(0, detectors.size())];
    camera.detector_settings = any_settings_of(camera.detector->options);
    fill(vision::tracker_options, &camera.tracker);
    return camera;
}

Settings any_settings() {
    Settings settings;
    Site& site = settings.engine.site;
    fill(site_options, &site);
    if (*rc::gen::arbitrary<bool>()) fill(origin_options, &site.origin.emplace());
    for (const auto i : up_to(5)) {
        fill(anchor_options, &site.anchors.emplace_back());
        site.anchors.back().name = any_name(i);
        site.anchors.back().address = address(i * 1000);
    }
    for (int i = *rc::gen::inRange(0, 4); i > 0; --i) fill(wall_options, &site.walls.emplace_back());
    for (const auto& section : config::flat_sections()) fill(section.rows, section.settings(settings));
    settings.engine.fusion.estimator = FusionSettings{}.estimator;
    settings.engine.clock_sync.master = site.anchors.empty() ? no_address : site.anchors.back().address;
    settings.publish.socket = "/run/\"odd\" \\name.sock";
    settings.engine.fusion.max_targets = 8;
    for (const auto i : up_to(5)) settings.engine.targets.push_back({any_name(i), address(i), ""});
    const bool tells_nmea = site.origin && !settings.engine.targets.empty();
    settings.nmea.target = tells_nmea ? settings.engine.targets.front().name : "";
    for (const auto i : up_to(4)) settings.inputs.push_back(any_input(i));
    for (const auto i : up_to(3)) settings.cameras.push_back(any_camera(i));
    settings.engine.cameras = settings.cameras.size();
    for (const auto& row : estimator_table()) {
        const auto own = row.options.make();
        fill(row.options.rows, own.get());
        settings.engine.estimators.push_back({&row, own});
    }
    return settings;
}

TEST(Print, LoadsBackToTheSame) {
    EXPECT_TRUE(rc::check([] {
        const auto printed = print_settings(any_settings());
        const auto again = load_settings_text(printed, "printed");
        if (!again.settings) RC_FAIL(to_string(again.problems.front()) + "\n" + printed);
        RC_ASSERT(print_settings(*again.settings) == printed);
    }));
}

TEST(Print, ShowsEveryOptionAlsoTheDefaults) {
    const auto result = load_settings_text("site: {name: bare}", "f");
    ASSERT_TRUE(result.settings);
    const auto printed = print_settings(*result.settings);
    Settings defaults;
    for (const auto& section : config::flat_sections())
        for (const auto& row : section.rows)
            EXPECT_EQ(printed.find(fmt::format("  {}: ", row.name)) == std::string::npos,
                      config::to_yaml(row.get(section.settings(defaults))).empty())
                << row.name;
    for (const auto& estimator : estimator_table())
        for (const auto& row : estimator.options.rows)
            EXPECT_NE(printed.find(fmt::format("    {}: ", row.name)), std::string::npos) << row.name;
}

TEST(Reference, CommittedPageIsTheGeneratedOne) {
    std::ifstream file(test::source_folder() + "/docs/settings.md");
    const std::string committed{std::istreambuf_iterator<char>(file), {}};
    EXPECT_TRUE(committed == reference_page())
        << "docs/settings.md is out of date: write it anew with `locus config --reference > docs/settings.md`";
}

} // namespace
} // namespace locus
