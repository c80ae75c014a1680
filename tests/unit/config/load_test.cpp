#include "drivers/uwb/trek1000.h"
#include "load_fixture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace locus {
namespace {

Settings loaded(std::string_view yaml) {
    const auto result = load_settings_text(yaml, "f");
    EXPECT_TRUE(result.settings) << problem_of(yaml);
    return result.settings.value_or(Settings{});
}

TEST(Load, ReadsTheSite) {
    const Site site = loaded(hall).engine.site;
    EXPECT_EQ(site.name, "hall");
    ASSERT_EQ(site.anchors.size(), 3u);
    EXPECT_EQ(site.anchors[1].address, address(0x1234));
    EXPECT_EQ(site.anchors[2].address, address(0xDECA010203040506));
    EXPECT_EQ(site.anchors[2].position_site_m, (Vec3{10, -8.5, 2.5}));
    EXPECT_EQ(site.anchors[2].range_bias_m, -0.2);
    EXPECT_EQ(site.anchors[1].sigma_m, 0.05);
    EXPECT_TRUE(std::isnan(site.anchors[0].sigma_m));
    ASSERT_TRUE(site.origin);
    EXPECT_EQ(site.origin->longitude_deg, 11.6);
    EXPECT_EQ(site.origin->x_axis_heading_deg, Wgs84Anchor{}.x_axis_heading_deg);
}

TEST(Load, ReadsTargetsAndSections) {
    const Settings settings = loaded(hall);
    ASSERT_EQ(settings.engine.targets.size(), 1u);
    EXPECT_EQ(settings.engine.targets[0].name, "forklift-7");
    EXPECT_EQ(settings.engine.targets[0].address, address(7));
    EXPECT_EQ(settings.engine.fusion.rate_hz, 50);
    EXPECT_FALSE(settings.engine.fusion.accept_unknown_targets);
    EXPECT_EQ(settings.log.level, "debug");
}

TEST(Load, ReadsAnInputWithItsTransportAndDecoder) {
    const Settings settings = loaded(hall);
    ASSERT_EQ(settings.inputs.size(), 1u);
    const InputSettings& input = settings.inputs[0];
    EXPECT_EQ(input.name, "trek");
    EXPECT_EQ(input.delay_s, 0.002);
    EXPECT_EQ(input.transport, find_transport("serial"));
    EXPECT_EQ(input.decoder, find_decoder("trek1000"));
    const auto option_of = [](const OptionTable& table, const void* of, std::string_view name) {
        for (const auto& row : table.rows)
            if (row.name == name) return row.get(of);
        return OptionValue{};
    };
    EXPECT_EQ(option_of(input.transport->options, input.transport_settings.get(), "baud_bd"),
              OptionValue{std::int64_t{9600}});
    EXPECT_EQ(option_of(input.decoder->options, input.decoder_settings.get(), "tag_offset"),
              OptionValue{std::int64_t{16}});
}

TEST(Load, WhatIsLeftOutKeepsItsDefault) {
    const Settings settings = loaded("site: {name: bare}");
    EXPECT_EQ(settings.engine.fusion.window_s, FusionSettings{}.window_s);
    EXPECT_EQ(settings.publish.socket, PublishSettings{}.socket);
    EXPECT_EQ(settings.realtime.priority, RealtimeSettings{}.priority);
    EXPECT_TRUE(settings.inputs.empty());
    EXPECT_EQ(settings.engine.estimators.size(), estimator_table().size());
}

TEST(Load, MissingFileIsNotReadable) {
    const auto result = load_settings("/nonexistent/locusd.yaml");
    EXPECT_FALSE(result.readable);
    ASSERT_EQ(result.problems.size(), 1u);
    EXPECT_EQ(to_string(result.problems[0]), "/nonexistent/locusd.yaml: there is no such file");
}

TEST(Load, FolderIsNotReadable) {
    const auto result = load_settings("/tmp");
    EXPECT_FALSE(result.readable);
    EXPECT_NE(result.problems.at(0).message.find("a folder"), std::string::npos);
}

} // namespace
} // namespace locus
