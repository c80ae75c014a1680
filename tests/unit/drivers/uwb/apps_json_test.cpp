// The lines of protocols.md E-2 that uwb-apps print.
#include "drivers/uwb/apps_json.h"

#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace locus::uwb {
namespace {

test::Collector apps_decoded(std::string_view line, bool node_is_anchor = false) {
    const AppsSettings settings{address(9), node_is_anchor};
    test::Collector sink;
    make_apps_json(&settings)->decode(test::bytes_packet(std::string{line} + "\r\n"), sink);
    return sink;
}

constexpr std::string_view many =
    R"({"utime": 88307220,"nrng": {"seq": 224,"mask": 127,"rng": ["8.088","8.039","1.320","8.426","7.131","6.604","7.026"],"uid": ["1946","5199","5235","2293","1436","5936","3958"]}})";
constexpr std::string_view one =
    R"({"utime": 9484254696807, "twr": {"rng": "1.071","uid": "d22d"},"uid": "55a6", "diag": {"rssi": "-79.562","los": "1.000"}})";
constexpr std::string_view listener =
    R"({"id":"0x499b","ts":"2473.4125","msgid":50196,"vbat":"4.29","usb":1,"acc":"[0.254,-8.345,-5.99]","gyro":"[0.5,0.3,0.4]","mag":[-548,140,-373],"pres":102072,"ref_anchor":"492","meas":[{"addr":"492","ddist":"0.005","tqf":1,"rssi":"-82.8"},{"addr":"533","ddist":"0.698","tqf":1,"rssi":"-79.9"}]})";

TEST(AppsJson, RangesToManyPeers) {
    const auto ranges = apps_decoded(many).all<Range>();
    ASSERT_EQ(ranges.size(), 7u);
    EXPECT_EQ(ranges[0].anchor, address(0x1946));
    EXPECT_EQ(ranges[0].tag, address(9));
    EXPECT_EQ(ranges[0].range_m, 8.088);
    EXPECT_EQ(ranges[6].anchor, address(0x3958));
    EXPECT_EQ(ranges[6].range_m, 7.026);
}

TEST(AppsJson, ARangeToOnePeer) {
    const auto ranges = apps_decoded(one).all<Range>();
    ASSERT_EQ(ranges.size(), 1u);
    EXPECT_EQ(ranges[0].anchor, address(0xd22d));
    EXPECT_EQ(ranges[0].tag, address(0x55a6));
    EXPECT_EQ(ranges[0].range_m, 1.071);
    EXPECT_FLOAT_EQ(ranges[0].rx_power_dbm, -79.562f);
    EXPECT_EQ(ranges[0].line_of_sight, LineOfSight::clear);
    const auto turned = apps_decoded(one, true).all<Range>();
    EXPECT_EQ(turned.at(0).anchor, address(0x55a6));
    EXPECT_EQ(turned.at(0).tag, address(0xd22d));
}

TEST(AppsJson, ARangeWithAngles) {
    const auto ranges =
        apps_decoded(R"({"utime":1,"twr":{"raz":["5.397","1.662","null"],"uid":"d22d"},"uid":"55a6"})").all<Range>();
    ASSERT_EQ(ranges.size(), 1u);
    EXPECT_EQ(ranges[0].range_m, 5.397);
}

TEST(AppsJson, DifferencesAndPressureOfAListener) {
    const auto sink = apps_decoded(listener);
    ASSERT_EQ(sink.items.size(), 2u);
    const auto& difference = std::get<RangeDifference>(sink.items[0].observation);
    EXPECT_EQ(difference.anchor_a, address(0x492));
    EXPECT_EQ(difference.anchor_b, address(0x533));
    EXPECT_EQ(difference.tag, address(0x499b));
    EXPECT_EQ(difference.difference_m, 0.698);
    EXPECT_EQ(std::get<Pressure>(sink.items[1].observation).pressure_pa, 102072);
}

TEST(AppsJson, OtherLinesAreFramesAndDamagedOnesAreRefused) {
    EXPECT_EQ(apps_decoded(R"({"utime":1,"wcs":[1,2,3,4],"skew":4607182418800017408})").frames, 1);
    for (const std::string_view bad :
         {"booting", R"({"nrng":{"rng":["1.0"],"uid":[]}})", R"({"nrng":{"rng":["1.0"]}})", R"({"twr":{"uid":"d22d"}})",
          R"({"twr":{"rng":"x","uid":"d22d"}})", R"({"twr":{"rng":"1"},"uid":"zz"})",
          R"({"id":"1","meas":[{"addr":"2","ddist":"1"}]})", R"({"id":"1","ref_anchor":"2","meas":[7]})",
          R"({"twr":{"rng":"1.0","uid":"d22d"})"}) {
        const auto sink = apps_decoded(bad);
        EXPECT_EQ(sink.refusals, std::vector{Refusal::malformed}) << bad;
        EXPECT_TRUE(sink.items.empty()) << bad;
    }
}

TEST(AppsJson, ImpossibleValuesAreRefusedOneByOne) {
    const auto sink = apps_decoded(R"({"nrng":{"rng":["nan","-1","1e9","2.5"],"uid":["1","2","3","4"]}})");
    EXPECT_EQ(sink.all<Range>().size(), 1u);
    EXPECT_EQ(sink.refusals, std::vector(3, Refusal::out_of_range));
}

TEST(AppsJson, WhatIsEncodedIsParsed) {
    rc::check([](std::uint16_t node, const std::vector<std::uint16_t>& lengths_mm) {
        apps::Ranges ranges;
        apps::Differences differences{node, 0x12345, {}, 101325};
        for (std::size_t i = 0; i < std::min(lengths_mm.size(), apps::most_peers); ++i) {
            ranges.items.push_back({i + 1, lengths_mm[i] * 1e-3});
            differences.items.push_back({i + 1, lengths_mm[i] * -1e-3});
        }
        if (ranges.items.size() == 1) ranges.node = node;
        const auto line = apps::encode(ranges), other = apps::encode(differences);
        const auto back = apps::parse(std::string_view{line}.substr(0, line.size() - 2));
        const auto other_back = apps::parse(std::string_view{other}.substr(0, other.size() - 2));
        RC_ASSERT(back && other_back);
        RC_ASSERT(std::get<apps::Ranges>(*back).items.size() == ranges.items.size());
        RC_ASSERT(std::get<apps::Ranges>(*back).node == ranges.node);
        for (std::size_t i = 0; i < ranges.items.size(); ++i) {
            RC_ASSERT(std::get<apps::Ranges>(*back).items[i].peer == ranges.items[i].peer);
            RC_ASSERT(std::abs(std::get<apps::Ranges>(*back).items[i].range_m - ranges.items[i].range_m) < 1e-9);
            RC_ASSERT(std::get<apps::Differences>(*other_back).items[i].anchor == i + 1);
        }
        RC_ASSERT(std::get<apps::Differences>(*other_back).pressure_pa == 101325);
    });
}

} // namespace
} // namespace locus::uwb
