// What the decoders of PulsON radios on serial lines make of messages.
#include "drivers/uwb/pulson/pulson.h"

#include "drivers/uwb/pulson/envelope.h"
#include "drivers/uwb/pulson/messages.h"
#include "drivers/uwb/pulson/neighbors.h"
#include "drivers/uwb/pulson/radio_info.h"
#include "tests/examples/decoder_example.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>

#include <cmath>

namespace locus::uwb::pulson {
namespace {

using namespace std::chrono_literals;
using examples::from_hex;
using test::Collector;

constexpr Timestamp noon{12h};

/// A decoder of USB, fed message by message.
struct Line {
    explicit Line(PulsonSettings settings = {}) {
        settings.tag = address(18);
        decoder = make_usb(&settings);
    }
    template <class Message>
    Line& hears(const Message& message, Timestamp time = noon) {
        const auto bytes = UsbFormat::wrap(encode(message));
        decoder->decode(test::bytes_packet(bytes, time), sink);
        return *this;
    }
    std::vector<Range> ranges() const { return sink.all<Range>(); }

    std::unique_ptr<Decoder> decoder;
    Collector sink;
};

FullRange good_range() {
    return {.message = 7,
            .responder = 101,
            .precise_mm = 5234,
            .coarse_mm = 5300,
            .precise_sigma_mm = 21,
            .coarse_sigma_mm = 150,
            .parts = precise,
            .requester_edge = line_of_sight,
            .responder_edge = line_of_sight};
}

FullRange changed(auto change) {
    FullRange range = good_range();
    change(range);
    return range;
}

const std::string range_message =
    "02 01 00 07 00 00 00 65 00 00 00 14 00 00 14 72 00 00 14 B4 00 00 14 78 00 15 00 96 00 19 FF 88 00 28 01 00 00 08 "
    "00 08 00 D2 10 68 00 00 02 3B 00 01 E2 40";

struct Wrapped {
    std::string name;
    std::string decoder;
    std::string hex;
    std::size_t ranges;
};

class PulsonExample : public testing::TestWithParam<Wrapped> {};

TEST_P(PulsonExample, IsUnderstood) {
    PulsonSettings settings;
    settings.tag = address(18);
    const auto decoder = find_decoder(GetParam().decoder)->make(&settings);
    Collector sink;
    decoder->decode(test::bytes_packet(from_hex(GetParam().hex)), sink);
    EXPECT_EQ(sink.frames, 1);
    EXPECT_TRUE(sink.refusals.empty());
    ASSERT_EQ(sink.items.size(), GetParam().ranges);
    for (const Range& range : sink.all<Range>()) {
        EXPECT_EQ(range.anchor, address(101));
        EXPECT_EQ(range.tag, address(18));
        EXPECT_NEAR(range.range_m, 5.234, 0.005);
        EXPECT_NEAR(range.sigma_m, 0.021f, 0.0011f);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Page, PulsonExample,
    testing::Values(Wrapped{"config", "pulson_uart",
                            "A5 A5 00 20 01 02 00 01 00 00 00 12 00 07 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 08 "
                            "93 CC 00 00 00 00 "
                            "35 15",
                            0},
                    Wrapped{"confirm", "pulson_uart", "A5 A5 00 08 01 03 00 07 00 00 00 00 F8 85", 0},
                    Wrapped{"range_usb", "pulson_usb", "A5 A5 00 34" + range_message, 1},
                    Wrapped{"range_uart", "pulson_uart", "A5 A5 00 34" + range_message + "FC 7D", 1},
                    Wrapped{"small_range", "pulson_usb", "A5 A5 00 0E 02 05 00 07 00 00 00 65 02 0B 02 01 00 00", 1},
                    Wrapped{"small_range_by_its_other_type", "pulson_usb",
                            "A5 A5 00 0E 32 01 00 07 00 00 00 65 02 0B 02 01 00 00", 1}),
    [](const auto& instance) { return instance.param.name; });

TEST(Pulson, TheEnvelopesOfTheVendorsDocument) {
    const auto get_config = from_hex("00 02 00 01");
    EXPECT_EQ(UsbFormat::wrap(get_config), from_hex("A5 A5 00 04 00 02 00 01"));
    EXPECT_EQ(UartFormat::wrap(get_config), from_hex("A5 A5 00 04 00 02 00 01 7E 41"));
}

TEST(Pulson, ARangeSaysAllThatTheRadioSays) {
    const Range range = Line{}.hears(good_range()).ranges().at(0);
    EXPECT_EQ(range.anchor, address(101));
    EXPECT_EQ(range.tag, address(18));
    EXPECT_DOUBLE_EQ(range.range_m, 5.234);
    EXPECT_FLOAT_EQ(range.sigma_m, 0.021f);
    EXPECT_EQ(range.line_of_sight, LineOfSight::clear);
}

TEST(Pulson, ARadioThatIsAnAnchorRangesToTags) {
    const Range range = Line{{.radio_is_anchor = true}}.hears(good_range()).ranges().at(0);
    EXPECT_EQ(range.anchor, address(18));
    EXPECT_EQ(range.tag, address(101));
}

TEST(Pulson, ASigmaOfNothingIsNone) {
    const auto range = changed([](FullRange& r) { r.precise_sigma_mm = 0; });
    EXPECT_TRUE(std::isnan(Line{}.hears(range).ranges().at(0).sigma_m));
}

TEST(Pulson, AnythingButSuccessMeasuresNothing) {
    for (const int status : {1, 2, 3, 4, 5, 6, 7, 9, 11, 32, 64, 66, 255}) {
        Line line;
        line.hears(changed([&](FullRange& r) { r.status = static_cast<std::uint8_t>(status); }));
        line.hears(
            SmallRange{.responder = 7, .range_cm = 1, .parts = precise, .status = static_cast<std::uint8_t>(status)});
        EXPECT_TRUE(line.ranges().empty() && line.sink.refusals.empty()) << status;
        EXPECT_EQ(line.sink.frames, 2);
    }
}

TEST(Pulson, CoarseRangesOnlyWhereTheyAreWanted) {
    const auto update = changed([](FullRange& r) { r.parts = coarse, r.status = coarse_update; });
    EXPECT_TRUE(Line{}.hears(update).ranges().empty());
    const Range range = Line{{.use_coarse = true}}.hears(update).ranges().at(0);
    EXPECT_DOUBLE_EQ(range.range_m, 5.3);
    EXPECT_FLOAT_EQ(range.sigma_m, 0.15f);
    const auto both = changed([](FullRange& r) { r.parts = precise | coarse; });
    EXPECT_DOUBLE_EQ(Line{{.use_coarse = true}}.hears(both).ranges().at(0).range_m, 5.234) << "the better one";
    const auto only_filtered = changed([](FullRange& r) { r.parts = filtered; });
    EXPECT_TRUE(Line{{.use_coarse = true}}.hears(only_filtered).ranges().empty())
        << "what is filtered is no new sample";
}

TEST(Pulson, LineOfSightIsThatOfBothEnds) {
    const auto sight = [](std::uint16_t requester, std::uint16_t responder) {
        const auto range = changed([&](FullRange& r) { r.requester_edge = requester, r.responder_edge = responder; });
        return Line{}.hears(range).ranges().at(0).line_of_sight;
    };
    EXPECT_EQ(sight(8, 8), LineOfSight::clear);
    EXPECT_EQ(sight(8, 16), LineOfSight::blocked);
    EXPECT_EQ(sight(16 | 4, 0), LineOfSight::blocked);
    EXPECT_EQ(sight(8, 4), LineOfSight::unknown);
    EXPECT_EQ(sight(0, 0), LineOfSight::unknown);
}

TEST(Pulson, AnImpossibleRangeIsRefused) {
    const auto range = changed([](FullRange& r) { r.precise_mm = 10'000'001; });
    EXPECT_EQ(Line{}.hears(range).sink.refusals, std::vector{Refusal::out_of_range});
}

TEST(Pulson, AnEchoIsOfTwoOthersAndCountsOnce) {
    EchoedRange echo{.requester = 30, .responder = 101, .precise_mm = 4000, .precise_sigma_mm = 30, .timestamp = 99};
    Line line{{.radio_is_anchor = true}};
    line.hears(echo).hears(echo);
    ASSERT_EQ(line.ranges().size(), 1u);
    EXPECT_EQ(line.ranges()[0].anchor, address(101));
    EXPECT_EQ(line.ranges()[0].tag, address(30));
    EXPECT_DOUBLE_EQ(line.ranges()[0].range_m, 4);
    echo.timestamp = 100;
    EXPECT_EQ(line.hears(echo).ranges().size(), 2u);
}

FullNeighbors full_database(std::uint32_t timestamp_ms, std::uint32_t ranged_ms) {
    FullNeighbors database{.count = 2, .timestamp_ms = timestamp_ms};
    database.neighbors[0] = {.node = 101,
                             .range_mm = 2500,
                             .sigma_mm = 20,
                             .parts = precise,
                             .edges = line_of_sight,
                             .ranged_ms = ranged_ms};
    database.neighbors[1] = {.node = 102, .status = timeout, .range_mm = 9, .parts = precise, .ranged_ms = ranged_ms};
    return database;
}

TEST(Pulson, AFullDatabaseGivesWhatIsNewInItWithItsOwnTime) {
    Line line;
    line.hears(full_database(5000, 4900)).hears(full_database(5500, 4900), noon + 500ms);
    ASSERT_EQ(line.ranges().size(), 1u) << "the second holds nothing new";
    EXPECT_EQ(line.sink.items[0].time, noon - 100ms);
    EXPECT_EQ(line.ranges()[0].anchor, address(101));
    EXPECT_DOUBLE_EQ(line.ranges()[0].range_m, 2.5);
    EXPECT_EQ(line.ranges()[0].line_of_sight, LineOfSight::clear);
    line.hears(full_database(6000, 5501), noon + 1s);
    EXPECT_EQ(line.ranges().size(), 2u);
    line.hears(full_database(6500, 6600), noon + 2s);
    EXPECT_EQ(line.ranges().size(), 2u) << "ranged in the future";
}

TEST(Pulson, ASmallDatabaseGivesWhatIsNewInIt) {
    SmallNeighbors database{.count = 2};
    database.neighbors[0] = {.node = 101, .range_cm = 250, .sigma_cm = 2, .age_ms = 100, .parts = precise};
    database.neighbors[1] = {.node = 102, .range_cm = 300, .age_ms = 5000, .parts = precise};
    Line line;
    line.hears(database).hears(database, noon + 90ms);
    ASSERT_EQ(line.ranges().size(), 1u);
    EXPECT_EQ(line.sink.items[0].time, noon - 100ms);
    EXPECT_DOUBLE_EQ(line.ranges()[0].range_m, 2.5);
    EXPECT_EQ(line.hears(database, noon + 300ms).ranges().size(), 2u);
}

TEST(Pulson, ADatabaseBesideTheRangesThemselvesIsSilent) {
    Line line;
    line.hears(good_range()).hears(full_database(5000, 4900), noon + 100ms);
    EXPECT_EQ(line.ranges().size(), 1u);
    EXPECT_EQ(line.hears(full_database(8000, 7900), noon + 3s).ranges().size(), 2u);
}

TEST(Pulson, OtherMessagesAreUnderstood) {
    Line line;
    line.hears(Confirm{}).hears(Config{}).hears(StatusInfo{}).hears(DataInfo{}).hears(ScanInfo{});
    EXPECT_EQ(line.sink.frames, 5);
    EXPECT_TRUE(line.sink.refusals.empty() && line.sink.items.empty());
}

std::vector<Refusal> refusals(std::string_view decoder, std::string_view hex) {
    Collector sink;
    test::default_decoder(decoder)->decode(test::bytes_packet(from_hex(hex)), sink);
    return sink.refusals;
}

TEST(Pulson, WhatIsNoMessageIsRefused) {
    using enum Refusal;
    EXPECT_EQ(refusals("pulson_uart", "A5 A5 00 04 00 02 00 01 7E 42"), (std::vector{bad_checksum, garbage}));
    Collector sink;
    test::default_decoder("pulson_uart")->decode(test::bytes_packet(UartFormat::wrap(from_hex("12 34 00 01"))), sink);
    EXPECT_EQ(sink.refusals, std::vector{unknown_type});
    EXPECT_EQ(refusals("pulson_uart", "A5 A5 FF FF"), (std::vector{malformed, garbage}));
    EXPECT_EQ(refusals("pulson_usb", "A5 A5 00 04 12 34 00 01"), (std::vector{unknown_type, garbage}));
    EXPECT_EQ(refusals("pulson_usb", "A5 A5 00 08 02 05 00 07 00 00 00 65"), (std::vector{malformed, garbage}));
    EXPECT_EQ(refusals("pulson_usb", "A5 A5 00 0E 02 05 00 07 00 00 00 65 02 0B 02 01 00 00 33"),
              (std::vector{malformed, garbage}))
        << "what follows at once is no head";
}

TEST(Pulson, TheSampleIsDatedWhenItsMessageBegan) {
    const auto bytes = UartFormat::wrap(encode(good_range()));
    PulsonSettings settings;
    Collector sink;
    make_uart(&settings)->decode(test::bytes_packet(bytes, noon, 100us), sink);
    EXPECT_EQ(sink.items.at(0).time, noon - 58 * 100us);
}

} // namespace
} // namespace locus::uwb::pulson
