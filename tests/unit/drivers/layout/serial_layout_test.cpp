#include "drivers/layout/serial_layout.h"

#include "tests/examples/decoder_example.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace locus::layout {
namespace {

SerialLayoutSettings described(std::size_t which) {
    std::vector<SerialLayoutSettings> all;
    for (const auto& example : examples::all())
        if (example.decoder == "serial_layout")
            all.push_back(*std::static_pointer_cast<SerialLayoutSettings>(example.settings));
    return all.at(which);
}

test::Collector hear(const SerialLayoutSettings& settings, const examples::Chunk& bytes) {
    EXPECT_EQ(check_serial_layout(&settings), "");
    test::Collector sink;
    make_serial_layout(&settings)->decode(test::bytes_packet(bytes), sink);
    return sink;
}

/// REAL, protocols.md E-4c: a LinkTrack tag that hears four anchors.
const auto nodeframe3 = examples::from_hex("55 05 32 00 02 01 f8 11 07 00 6f d0 6e 00 00 00 01 02 5a 13 04 01 00 22 0b "
                                           "00 b5 9f 01 01 a3 17 00 b6 a0 01 02 88 1c "
                                           "00 aa 9f 01 03 e6 14 00 b8 a0 9a");

TEST(SerialLayout, ReadsADeviceItKnowsByDescriptionOnly) {
    const auto sink = hear(described(0), nodeframe3);
    EXPECT_TRUE(sink.refusals.empty());
    const auto ranges = sink.all<Range>();
    ASSERT_EQ(ranges.size(), 4u);
    const std::array metres{2.850, 6.051, 7.304, 5.350};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_DOUBLE_EQ(ranges[i].range_m, metres[i]);
        EXPECT_EQ(ranges[i].anchor, address(i));
        EXPECT_EQ(ranges[i].tag, address(1));
    }
    EXPECT_EQ(ranges[0].rx_power_dbm, -79.5f);
}

TEST(SerialLayout, AnElementsIndexIsItsAnchorAndZeroSaysNotSeen) {
    auto bytes = examples::from_hex("AA 25 01 CE 04 00 00 24 09 00 00 00 00 00 00 7A 0D 00 00");
    bytes.resize(37); // two bytes more that nobody has explained
    const auto sink = hear(described(1), bytes);
    const auto ranges = sink.all<Range>();
    ASSERT_EQ(ranges.size(), 3u);
    EXPECT_EQ(ranges[0].range_m, 1.230);
    EXPECT_EQ(ranges[2].range_m, 3.450);
    EXPECT_EQ(ranges[2].anchor, address(3));
    EXPECT_EQ(ranges[2].tag, address(9));
    EXPECT_EQ(sink.refusals, std::vector{Refusal::garbage}) << "the trailer";
}

TEST(SerialLayout, ACountBeyondTheFrameIsNotBelieved) {
    auto bytes = encode(described(0), std::vector<std::vector<double>>{{1, 0, 2850, -80}});
    bytes[20] = 200;
    bytes.back() = static_cast<std::uint8_t>(bytes.back() + 199);
    const auto sink = hear(described(0), bytes);
    EXPECT_TRUE(sink.items.empty());
    EXPECT_EQ(sink.refusals, std::vector{Refusal::malformed});
}

TEST(SerialLayout, EveryLengthRuleAndChecksumReadsWhatItWrites) {
    rc::check([] {
        SerialLayoutSettings settings;
        settings.sync = "A5 5A";
        settings.checksum = std::string(*rc::gen::elementOf(checksum_names));
        settings.checksum_byte_order = std::string(*rc::gen::elementOf(serial_byte_orders));
        settings.length_byte_order = std::string(*rc::gen::elementOf(serial_byte_orders));
        settings.length_bytes = *rc::gen::inRange(1, 4);
        settings.length_adds = *rc::gen::inRange(-8, 9);
        settings.checksum_from_byte = *rc::gen::inRange(0, 4);
        settings.checksum_trailer_bytes = *rc::gen::inRange(0, 3);
        settings.frame_bytes = *rc::gen::elementOf(std::vector{0, 24});
        settings.tag = address(4);
        settings.fields = {{.quantity = "range", .at_byte = 6, .bytes = 4, .factor = 0.5, .offset = 3, .unit = "cm"},
                           {.quantity = "anchor", .at_byte = 10, .bytes = 2, .byte_order = "big"}};
        const double range_cm = 3 + 0.5 * *rc::gen::inRange(0, 100'000);
        const double anchor = *rc::gen::inRange(0, 65536);
        RC_ASSERT(check_serial_layout(&settings).empty());
        const auto sink = hear(settings, encode(settings, std::vector<std::vector<double>>{{range_cm, anchor}}));
        const auto ranges = sink.all<Range>();
        RC_ASSERT(ranges.size() == 1u);
        RC_ASSERT(std::abs(ranges[0].range_m * 100 - range_cm) < 1e-9);
        RC_ASSERT(ranges[0].anchor == address(static_cast<std::uint64_t>(anchor)));
    });
}

TEST(SerialLayout, SaysWhatDoesNotFitTogether) {
    SerialLayoutSettings settings;
    settings.sync = "A5 5";
    EXPECT_EQ(check_serial_layout(&settings), "sync must be 1 to 16 bytes in hex, as in \"AA 25 01\"");
    settings.sync = "A5";
    EXPECT_EQ(check_serial_layout(&settings), "fields is empty: without it no frame means anything");
    settings.fields = {{.quantity = "range", .at_byte = 3, .bytes = 4, .unit = "mm"}};
    settings.frame_bytes = 6;
    EXPECT_EQ(check_serial_layout(&settings), "item 1 of fields (range): it ends beyond the frame (frame_bytes)");
    settings.fields[0].at_byte = 2;
    settings.checksum = "crc16_modbus";
    settings.checksum_trailer_bytes = 4;
    EXPECT_EQ(check_serial_layout(&settings), "frame_bytes is 6, but sync, checksum and tail alone need 7");
}

} // namespace
} // namespace locus::layout
