#include "drivers/uwb/listener_json.h"

#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace locus::uwb {
namespace {

using test::Collector;

Collector listened(std::string_view text) {
    const ListenerSettings settings{address(0x8001)};
    Collector sink;
    make_listener_json(&settings)->decode(test::bytes_packet(text), sink);
    return sink;
}

/// protocols.md E-2, REAL, as the rest of these lines.
constexpr std::string_view blink_lines =
    R"({"ts":418793104067,"utime":92619018,"rssi0":"-90.9","rssi1":"-94.4","pd":"1.374","dlen":10,"d":"c5cbf01c0010c2bf4020"}
{"ts":419282763488,"utime":92626678,"rssi0":"-90.9","rssi1":"-94.4","pd":"0.305","dlen":10,"d":"c5ccf01c0010c2bf4020"}
{"ts":419784023582,"utime":92634521,"rssi0":"-91.1","rssi1":"-94.0","pd":"0.014","dlen":10,"d":"c5cdf01c0010c2bf4020"}
{"ts":420283186433,"utime":92642333,"rssi0":"-90.8","rssi1":"-93.9","pd":"0.234","dlen":10,"d":"c5cef01c0010c2bf4020"}
)";

TEST(ListenerJson, RealBlinksAreArrivals) {
    const auto arrivals = listened(blink_lines).all<Arrival>();
    ASSERT_EQ(arrivals.size(), 4u);
    const std::array ticks{418793104067u, 419282763488u, 419784023582u, 420283186433u};
    const std::array power_dbm{-90.9f, -90.9f, -91.1f, -90.8f};
    for (unsigned i = 0; i < 4; ++i) {
        EXPECT_EQ(arrivals[i].anchor, address(0x8001));
        EXPECT_EQ(arrivals[i].tag, address(0x2040BFC210001CF0));
        EXPECT_EQ(arrivals[i].rx_anchor_ticks_in_anchor, ticks[i]);
        EXPECT_EQ(arrivals[i].sequence, 203 + i);
        EXPECT_FLOAT_EQ(arrivals[i].rx_power_dbm, power_dbm[i]);
    }
}

TEST(ListenerJson, RealSyncPacketsAreClockSyncs) {
    const auto syncs =
        listened(
            R"({"utime":32240936,"ts":959949481290,"rssi":-84.0,"dlen":30,"d":"c5939204b2cf86c102049204000000000400000050c03791490713000004"}
{"utime":32509826,"ts":977129894189,"rssi":-84.1,"dlen":30,"d":"c5949204b2cf86c1020492040000000004000000500038914d0713000004"}
)")
            .all<ClockSync>();
    ASSERT_EQ(syncs.size(), 2u);
    EXPECT_EQ(syncs[0].transmitter, address(0x0402C186CFB20492));
    EXPECT_EQ(syncs[0].receiver, address(0x8001));
    EXPECT_EQ(syncs[0].tx_transmitter_ticks_in_transmitter, 0x499137C050u);
    EXPECT_EQ(syncs[0].rx_receiver_ticks_in_receiver, 959949481290u);
    EXPECT_EQ(syncs[0].sequence, 147u);
    const auto master = syncs[1].tx_transmitter_ticks_in_transmitter - syncs[0].tx_transmitter_ticks_in_transmitter;
    const auto local = syncs[1].rx_receiver_ticks_in_receiver - syncs[0].rx_receiver_ticks_in_receiver;
    EXPECT_EQ(master, 17179885568u);
    EXPECT_EQ(local, 17180412899u);
}

TEST(ListenerJson, OfTwoReceiversTheFirstCounts) {
    const auto report = parse_listener_report(
        R"({"utime":3219787,"ts":[203624381252,203624381278],"rssi":[-80.5,-81.3],"fppl":[-84.5,-85.3],"pd":[1.267],"dlen":2,"d":"c543","cir0":{"x":[1,2]},"cir1":null})");
    ASSERT_TRUE(report);
    EXPECT_EQ(report->received_ticks, 203624381252u);
    EXPECT_FLOAT_EQ(report->rx_power_dbm, -80.5f);
    EXPECT_FLOAT_EQ(report->first_path_power_dbm, -84.5f);
}

TEST(ListenerJson, APowerThatIsNullIsNotKnown) {
    const auto report = parse_listener_report(R"({"ts":1,"rssi":[null,-81.3],"fppl":"nan","d":"c5"})");
    ASSERT_TRUE(report);
    EXPECT_TRUE(std::isnan(report->rx_power_dbm));
    EXPECT_TRUE(std::isnan(report->first_path_power_dbm));
}

std::string line_of(const std::vector<std::uint8_t>& frame) {
    ListenerReport report;
    report.frame.assign(frame.begin(), frame.end());
    return encode(report);
}

TEST(ListenerJson, OtherFramesAndRepeatedSyncsAreNoMeasurement) {
    using namespace ieee802154;
    const Collector sink =
        listened(line_of(encode(ClockCalibration{1, 2, 3, 4, 5, 1, 4, {}})) + line_of(encode(Data{1, 2, 3, 4, {}})) +
                 line_of(std::vector<std::uint8_t>(20, 0xC5)));
    EXPECT_EQ(sink.frames, 3);
    EXPECT_TRUE(sink.items.empty());
    EXPECT_TRUE(sink.refusals.empty());
}

TEST(ListenerJson, RefusesDamage) {
    for (const std::string line :
         {R"({"ts":1,"dlen":9,"d":"c5cbf01c0010c2bf4020"})", R"({"ts":1,"dlen":10,"d":"c5cbf01c0010c2bf402"})",
          R"({"ts":1,"dlen":10,"d":"c5cbf01c0010c2bf40g0"})", R"({"ts":1099511627776,"d":"c5"})",
          R"({"ts":-1,"d":"c5"})", R"({"ts":1.5,"d":"c5"})", R"({"d":"c5"})", R"({"ts":1})", R"({"ts":1,"d":"c5"}{)",
          R"({"ts":1,"d":"c5")", R"({"ts":1,"d":"c5","d":"c6"})", R"({"ts":[],"d":"c5"})", R"("ts":1,"d":"c5"})",
          "x"}) {
        const Collector sink = listened(line + "\n");
        EXPECT_EQ(sink.refusals, std::vector<Refusal>{Refusal::malformed}) << line;
        EXPECT_TRUE(sink.items.empty());
    }
    EXPECT_EQ(listened(line_of(std::vector<std::uint8_t>(127))).frames, 1);
    EXPECT_EQ(listened(R"({"ts":1,"d":")" + std::string(256, '0') + "\"}\n").refusals.size(), 1u);
}

TEST(ListenerJson, ReadsBackWhatItWrites) {
    EXPECT_TRUE(rc::check([](std::uint32_t clock_us, std::vector<std::uint8_t> frame) {
        ListenerReport said;
        said.received_ticks = *rc::gen::inRange<std::uint64_t>(0, std::uint64_t{1} << 40);
        said.clock_us = clock_us;
        said.rx_power_dbm = -0.5f * static_cast<float>(*rc::gen::inRange(1, 250));
        said.frame.assign(frame.begin(),
                          frame.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(frame.size(), 127)));
        std::string line = encode(said);
        line.resize(line.size() - 2);
        const auto read = parse_listener_report(line);
        RC_ASSERT(read.has_value());
        RC_ASSERT(read->received_ticks == said.received_ticks);
        RC_ASSERT(read->clock_us == said.clock_us);
        RC_ASSERT(read->rx_power_dbm == said.rx_power_dbm);
        RC_ASSERT(std::isnan(read->first_path_power_dbm));
        RC_ASSERT(read->frame == said.frame);
    }));
}

} // namespace
} // namespace locus::uwb
