#include "drivers/uwb/dwm1001_shell.h"

#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace locus::uwb::dwm1001 {
namespace {

using namespace std::chrono_literals;
using test::Collector;

/// protocols.md E-3, REAL.
constexpr std::string_view lec_line =
    "DIST,4,AN0,2F2F,3.05,2.68,0.00,2.21,AN1,2C9D,-0.04,2.91,0.00,2.39,AN2,2ED0,3.02,0.00,"
    "0.00,2.19,AN3,2BA2,0.00,0.00,0.00,2.56,POS,1.59,1.65,1.27,44";
constexpr std::string_view les_line = "1151[5.00,8.00,2.25]=6.48 0CA8[0.00,8.00,2.25]=6.51 111C[5.00,0.00,2.25]=3.18 "
                                      "1150[0.00,0.00,2.25]=3.16 le_us=2576 est[2.57,1.98,1.68,100]";

Collector decode_all(std::string_view text, const Dwm1001ShellSettings& settings = {}) {
    Collector sink;
    make_dwm1001_shell(&settings)->decode(test::bytes_packet(text), sink);
    return sink;
}

void expect_ranges(std::string_view line, const std::vector<std::pair<unsigned, double>>& expected) {
    const auto ranges = decode_all(std::string{line} + "\r\n", {address(0x0090)}).all<Range>();
    ASSERT_EQ(ranges.size(), expected.size());
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        EXPECT_EQ(ranges[i].anchor, address(expected[i].first));
        EXPECT_EQ(ranges[i].tag, address(0x0090));
        EXPECT_DOUBLE_EQ(ranges[i].range_m, expected[i].second);
    }
}

TEST(Dwm1001Shell, ReadsTheRealLines) {
    expect_ranges(lec_line, {{0x2F2F, 2.21}, {0x2C9D, 2.39}, {0x2ED0, 2.19}, {0x2BA2, 2.56}});
    expect_ranges(les_line, {{0x1151, 6.48}, {0x0CA8, 6.51}, {0x111C, 3.18}, {0x1150, 3.16}});
    const auto lec = parse_shell_line(lec_line), les = parse_shell_line(les_line);
    ASSERT_TRUE(lec && les);
    EXPECT_EQ(lec->distances[1], (Distance{0x2C9D, {-4, 291, 0}, 239}));
    EXPECT_EQ(lec->position, (Position{{159, 165, 127}, 44}));
    EXPECT_EQ(les->solver_us, 2576u);
    EXPECT_EQ(les->position, (Position{{257, 198, 168}, 100}));
    EXPECT_EQ(parse_shell_line("POS,2.57,2.00,1.67,97")->position, (Position{{257, 200, 167}, 97}));
    EXPECT_EQ(parse_shell_line("x:2570 y:-2000 z:1670 qf:97")->position, (Position{{257, -200, 167}, 97}));
}

TEST(Dwm1001Shell, WritesWhatTheModulePrints) {
    for (const auto line : {lec_line, les_line, std::string_view{"POS,2.57,2.00,1.67,97"}})
        EXPECT_EQ(encode(*parse_shell_line(line)), std::string{line} + "\r\n");
}

TEST(Dwm1001Shell, PositionsAreFramesWithoutMeasurements) {
    const Collector sink = decode_all("POS,2.57,2.00,1.67,97\r\nx:2570 y:2000 z:1670 qf:97\r\nDIST,0\r\nle_us=100\r\n");
    EXPECT_EQ(sink.frames, 4);
    EXPECT_TRUE(sink.items.empty());
    EXPECT_TRUE(sink.refusals.empty());
}

TEST(Dwm1001Shell, ThePromptMayStandBeforeALine) {
    EXPECT_EQ(decode_all("dwm> dwm> " + std::string{lec_line} + "\r\ndwm> \r\n").items.size(), 4u);
}

TEST(Dwm1001Shell, RefusesWhatLostCharacters) {
    const std::vector<std::string> lines{
        "DIST,4,AN0,0090,1.00,2.00,0.00,3.10,AN3,15BA,0.00,0,AN3,15BA,0.00,0.00,0.00,0.00", // E-3, REAL, shortened
        "DIST,2,AN0,2F2F,3.05,2.68,0.00,2.21",                                              // an anchor is missing
        "DIST,1,AN0,2F2F,3.05,2.68,0.00,2.21,AN1,2C9D,-0.04,2.91,0.00,2.39",                // one too many
        "DIST,1,AN1,2F2F,3.05,2.68,0.00,2.21",                                              // index
        "DIST,1,AN0,2FF,3.05,2.68,0.00,2.21",                                               // digits of the id
        "DIST,1,AN0,2F2F0,3.05,2.68,0.00,2.21",
        "DIST,1,AN0,2F2F,3.05,2.68,0.00,2.1",
        "DIST,1,AN0,2F2F,3.05,2.68,0.00,.21",
        "DIST,1,AN0,2F2F,3.05,2.68,2.21",
        "DIST,1,AN0,2F2F,3.05,2.68,0.00,2.21,POS,1.59,1.65,44",
        "DIST,1,AN0,2F2F,3.05,2.68,0.00,2.21,POS,1.59,1.65,1.27,101",
        "DIST,2,AN0,2F2F,3.05,2.68,0.00,2.21,AN1,2F2F,3.05,2.68,0.00,2.21", // one anchor twice
        "DIST,99999999999999999999",
        "DIST,17,AN0",
        "1151[5.00,8.00,2.25]=6.48",
        "1151[5.00,8.00,2.25]=6.48 0CA8[0.00,8.00,2.25=6.51 le_us=2576",
        "1151[5.00,8.00,2.25]=6.48 le_us=2576 est[2.57,1.98,1.68,100",
        "POS,2.57,2.00,1.67",
        "x:2570 y:2000 qf:97",
        "lec",
    };
    for (const auto& line : lines) {
        const Collector sink = decode_all(line + "\r\n");
        EXPECT_EQ(sink.refusals, std::vector<Refusal>{Refusal::malformed}) << line;
        EXPECT_TRUE(sink.items.empty()) << line;
    }
}

TEST(Dwm1001Shell, ImpossibleDistancesAreRefusedAndZeroIsNotMeasured) {
    const Collector sink = decode_all("DIST,3,AN0,0001,0.00,0.00,0.00,-0.01,AN1,0002,0.00,0.00,0.00,1000.01,"
                                      "AN2,0003,0.00,0.00,0.00,0.00\r\n");
    EXPECT_EQ(sink.refusals, (std::vector<Refusal>{Refusal::out_of_range, Refusal::out_of_range}));
    EXPECT_TRUE(sink.items.empty());
}

TEST(Dwm1001Shell, StampIsWhenTheLineBegan) {
    Collector sink;
    test::default_decoder("dwm1001_shell")
        ->decode(test::bytes_packet("DIST,1,AN0,2F2F,3.05,2.68,0.00,2.21\r\n", timestamp_from_ns(10'000), 100ns), sink);
    ASSERT_EQ(sink.items.size(), 1u);
    EXPECT_EQ(to_ns(sink.items[0].time), 10'000 - 37 * 100);
}

std::string asked(Decoder& decoder, Timestamp now) {
    const auto packet = decoder.request(now);
    return packet ? std::string{packet->data.begin(), packet->data.end()} : "";
}

TEST(Dwm1001Shell, SendsNothingUnlessTold) {
    const auto decoder = test::default_decoder("dwm1001_shell");
    for (Timestamp now{}; now < Timestamp{20s}; now += 100ms) EXPECT_EQ(asked(*decoder, now), "");
}

TEST(Dwm1001Shell, AsksForTheStreamOnlyInSilence) {
    const Dwm1001ShellSettings settings{address(1), true};
    const auto decoder = make_dwm1001_shell(&settings);
    Collector sink;
    EXPECT_EQ(asked(*decoder, Timestamp{1s}), "");
    EXPECT_EQ(asked(*decoder, Timestamp{2900ms}), "");
    EXPECT_EQ(asked(*decoder, Timestamp{3s}), "\r\r");
    EXPECT_EQ(asked(*decoder, Timestamp{3900ms}), "");
    EXPECT_EQ(asked(*decoder, Timestamp{4s}), "lec\r");
    decoder->decode(test::bytes_packet("dwm> lec\r\n"), sink); // its echo is no answer
    EXPECT_EQ(asked(*decoder, Timestamp{6s}), "\r\r");
    decoder->decode(test::bytes_packet("DIST,0\r\n"), sink);
    EXPECT_EQ(asked(*decoder, Timestamp{7s}), "");
    EXPECT_EQ(asked(*decoder, Timestamp{8900ms}), "");
    EXPECT_EQ(asked(*decoder, Timestamp{9s}), "\r\r");
}

ShellLine any_line() {
    const auto cm = [] { return *rc::gen::inRange<std::int64_t>(-100'000, 100'000); };
    ShellLine line;
    line.kind = *rc::gen::element(ShellLine::Kind::lec, ShellLine::Kind::les, ShellLine::Kind::position);
    if (line.kind == ShellLine::Kind::position || *rc::gen::arbitrary<bool>())
        line.position = Position{{cm(), cm(), cm()}, *rc::gen::inRange(0u, 101u)};
    if (line.kind == ShellLine::Kind::position) return line;
    for (unsigned i = *rc::gen::inRange(0u, 17u); i > 0; --i)
        line.distances.push_back({static_cast<std::uint16_t>(0xFFF0 + i), {cm(), cm(), cm()}, cm()});
    if (line.kind == ShellLine::Kind::les) line.solver_us = *rc::gen::arbitrary<std::uint32_t>();
    return line;
}

TEST(Dwm1001Shell, ReadsBackWhatItWrites) {
    EXPECT_TRUE(rc::check([] {
        const ShellLine line = any_line();
        std::string text = encode(line);
        text.resize(text.size() - 2);
        RC_ASSERT(parse_shell_line(text) == line);
    }));
}

} // namespace
} // namespace locus::uwb::dwm1001
