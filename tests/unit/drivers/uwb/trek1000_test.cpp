#include "drivers/uwb/trek1000.h"

#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <string>

namespace locus::uwb {
namespace {

using test::Collector;

Collector decode_all(std::string_view text) {
    Collector sink;
    test::default_decoder("trek1000")->decode(test::bytes_packet(text), sink);
    return sink;
}

struct Example {
    const char* line;
    TrekReport report;
};

/// protocols.md E-1: REAL, then DOC, then the HaoruTech variant of 1(a).
const std::vector<Example> examples{
    {"mr 07 00000407 0000082b 000007a3 00000000 6cba 09 40414041 a0:0",
     {'r', 7, 4, {1031, 2091, 1955}, 27834, 9, 0x40414041, 'a', 0, 0}},
    {"ma 0e 00000000 000006d9 0000069c 0000026b 6cbd 51 00a0641e a0:0",
     {'a', 14, 4, {0, 1753, 1692, 619}, 0x6cbd, 0x51, 10511390, 'a', 0, 0}},
    {"mc 07 000004ec 000008ee 0000087e 00000000 6cc0 0a 00a0642b a0:0",
     {'c', 7, 4, {1260, 2286, 2174}, 0x6cc0, 10, 10511403, 'a', 0, 0}},
    {"mc 07 000004de 00000901 000008a3 00000000 6cc6 0b 00a0648f a0:0",
     {'c', 7, 4, {1246, 2305, 2211}, 0x6cc6, 11, 10511503, 'a', 0, 0}},
    {"mc 07 000004b0 000008e5 00000854 00000000 2cef 15 00af89a4 t0:0",
     {'c', 7, 4, {1200, 2277, 2132}, 0x2cef, 21, 0x00af89a4, 't', 0, 0}},
    {"mc 0f 00000663 000005a3 00000512 000004cb 095f c1 00024c24 a0:0",
     {'c', 15, 4, {1635, 1443, 1298, 1227}, 2399, 193, 150564, 'a', 0, 0}},
    {"mr 0f 000005a4 000004c8 00000436 000003f9 0958 c0 40424042 a0:0",
     {'r', 15, 4, {1444, 1224, 1078, 1017}, 0x0958, 192, 0x40424042, 'a', 0, 0}},
    {"ma 07 00000000 0000085c 00000659 000006b7 095b 26 00024bed a0:0",
     {'a', 7, 4, {0, 2140, 1625, 1719}, 0x095b, 0x26, 150509, 'a', 0, 0}},
    {"mc 0f 00000663 000005a3 00000512 000004cb 095f c1 0 a0:0",
     {'c', 15, 4, {1635, 1443, 1298, 1227}, 2399, 193, 0, 'a', 0, 0}},
};

TEST(Trek1000, ReadsEveryExample) {
    for (const Example& example : examples) EXPECT_EQ(parse_trek_report(example.line), example.report) << example.line;
}

TEST(Trek1000, WritesWhatTheFirmwarePrints) {
    for (const Example& example : examples) {
        if (example.report.debug == 0) continue; // HaoruTech's shorter field is read, not written
        EXPECT_EQ(encode(example.report), std::string(example.line) + "\r\n");
    }
}

TEST(Trek1000, OnlyCorrectedRangesThatTheMaskCallsValidAreMeasurements) {
    const Collector sink = decode_all("mr 07 00000407 0000082b 000007a3 00000000 6cba 09 40414041 a0:0\r\n"
                                      "ma 0e 00000000 000006d9 0000069c 0000026b 6cbd 51 00a0641e a0:0\r\n"
                                      "mc 05 000004ec 000008ee 0000087e 00000001 6cc0 0a 00a0642b a3:0\r\n"
                                      "me 0000 0001 0002 0003 0004 0005 0006 0007 0008 0009\r\n");
    EXPECT_EQ(sink.frames, 4);
    EXPECT_TRUE(sink.refusals.empty());
    const auto ranges = sink.all<Range>();
    ASSERT_EQ(ranges.size(), 2u);
    EXPECT_EQ(ranges[0].anchor, address(0));
    EXPECT_EQ(ranges[0].tag, address(3));
    EXPECT_DOUBLE_EQ(ranges[0].range_m, 1.260);
    EXPECT_EQ(ranges[1].anchor, address(2));
    EXPECT_DOUBLE_EQ(ranges[1].range_m, 2.174);
}

TEST(Trek1000, MoreRangeColumnsAreMoreAnchors) {
    const auto ranges = decode_all("mc 81 00000001 00000000 00000000 00000000 00000000 00000000 00000000 00000008 "
                                   "095f c1 0 a12:0\r\n")
                            .all<Range>();
    ASSERT_EQ(ranges.size(), 2u);
    EXPECT_EQ(ranges[1].anchor, address(7));
    EXPECT_EQ(ranges[1].tag, address(12));
    EXPECT_DOUBLE_EQ(ranges[1].range_m, 0.008);
}

TEST(Trek1000, OffsetsMakeAddresses) {
    const TrekSettings settings{0x8000, 100};
    Collector sink;
    make_trek1000(&settings)->decode(test::bytes_packet("mc 02 00000000 00000005 0 0 0 a1:0\n"), sink);
    ASSERT_EQ(sink.all<Range>().size(), 1u);
    EXPECT_EQ(sink.all<Range>()[0].anchor, address(0x8001));
    EXPECT_EQ(sink.all<Range>()[0].tag, address(101));
}

TEST(Trek1000, StampIsWhenTheLineWasComplete) {
    Collector sink;
    const std::string text = encode(examples[3].report) + "mc";
    test::default_decoder("trek1000")
        ->decode(test::bytes_packet(text, timestamp_from_ns(1'000'000), Duration{100}), sink);
    ASSERT_EQ(sink.items.size(), 3u);
    EXPECT_EQ(to_ns(sink.items[2].time), 1'000'000 - 2 * 100);
}

TEST(Trek1000, RefusesWhatNoAnchorCanMeasureAndKeepsTheRest) {
    const Collector sink = decode_all("mc 0f ffffffff 01312d01 01312d00 00000000 095f c1 0 a0:0\n");
    EXPECT_EQ(sink.refusals, (std::vector<Refusal>{Refusal::out_of_range, Refusal::out_of_range}));
    const auto ranges = sink.all<Range>();
    ASSERT_EQ(ranges.size(), 2u);
    EXPECT_DOUBLE_EQ(ranges[0].range_m, 20e3);
    EXPECT_DOUBLE_EQ(ranges[1].range_m, 0);
}

TEST(Trek1000, SaysWhatIsWrongWithALine) {
    const std::vector<std::pair<std::string, Refusal>> lines{
        {"mc 07 000004ec 000008ee 0000087e 00000000 6cc0 0a 00a0642b", Refusal::malformed},      // role is missing
        {"mc 17 000004ec 000008ee 0000087e 00000000 6cc0 0a 00a0642b a0:0", Refusal::malformed}, // no fifth range
        {"mc 07 000004ec 00008ee 0000087e 00000000 6cc0 0a 00a0642b a0:0", Refusal::malformed},  // a digit is missing
        {"mc 07 000004ec 00000xee 0000087e 00000000 6cc0 0a 00a0642b a0:0", Refusal::malformed},
        {"mc 07 000004ec 000008ee 0000087e 00000000 6cc0 0a 00a0642b b0:0", Refusal::malformed},
        {"mc 07 000004ec 000008ee 0000087e 00000000 6cc0 0a 00a0642b a0", Refusal::malformed},
        {"mc 07 000004ec 000008ee 0000087e 00000000 6cc0 0a 00a0642b a-1:0", Refusal::malformed},
        {"mc 07 000004ec 000008ee 0000087e 00000000 6cc0 0a 1000a0642b a0:0", Refusal::malformed},
        {"mc 6cc0 0a 00a0642b a0:0", Refusal::malformed},
        {"mc", Refusal::malformed},
        {"mp 00 01", Refusal::unknown_type},
        {"$KT0, 1.69, 2.93, 0.00", Refusal::unknown_type},
        {"\x01\x02\xff", Refusal::garbage},
        {std::string(1000, 'x'), Refusal::too_long},
    };
    for (const auto& [line, reason] : lines) {
        const Collector sink = decode_all(line + "\r\n");
        EXPECT_EQ(sink.refusals, std::vector<Refusal>{reason}) << line;
        EXPECT_TRUE(sink.items.empty()) << line;
    }
}

TrekReport random_report() {
    TrekReport report;
    report.kind = *rc::gen::element('c', 'r', 'a');
    report.columns = *rc::gen::inRange<std::uint8_t>(1, TrekReport::max_ranges + 1);
    report.mask = *rc::gen::inRange<std::uint32_t>(0, 1u << report.columns);
    for (unsigned i = 0; i < report.columns; ++i) report.range_mm[i] = *rc::gen::inRange<std::int32_t>(0, 20'000'000);
    report.long_count = *rc::gen::arbitrary<std::uint16_t>();
    report.sequence = *rc::gen::arbitrary<std::uint8_t>();
    report.debug = *rc::gen::arbitrary<std::uint32_t>();
    report.role = *rc::gen::element('a', 't');
    report.tag = *rc::gen::arbitrary<std::uint16_t>();
    report.anchor = *rc::gen::arbitrary<std::uint16_t>();
    return report;
}

TEST(Trek1000, ReadsBackWhatItWrites) {
    EXPECT_TRUE(rc::check([] {
        const TrekReport report = random_report();
        std::string line = encode(report);
        RC_ASSERT(line.ends_with("\r\n"));
        line.resize(line.size() - 2);
        RC_ASSERT(parse_trek_report(line) == report);
    }));
}

std::string garbage() {
    auto bytes = *rc::gen::container<std::string>(rc::gen::arbitrary<char>());
    bytes.resize(std::min<std::size_t>(bytes.size(), 100));
    return bytes;
}

TEST(Trek1000, EveryIntactLineAfterDamageIsDelivered) {
    EXPECT_TRUE(rc::check([] {
        std::string stream;
        std::size_t expected = 0;
        for (int i = 0; i < 5; ++i) {
            TrekReport report = random_report();
            report.kind = 'c';
            const std::string line = encode(report);
            stream += garbage() + line.substr(0, *rc::gen::inRange<std::size_t>(0, 20)) + line;
            expected += static_cast<std::size_t>(std::popcount(report.mask));
        }
        const auto decoder = test::default_decoder("trek1000");
        Collector sink;
        for (const char& byte : stream) decoder->decode(test::bytes_packet({&byte, 1}), sink);
        RC_ASSERT(sink.items.size() == expected);
    }));
}

TEST(Trek1000, WhereTheStreamIsCutDoesNotMatter) {
    std::string stream;
    for (const Example& example : examples) stream += "noise " + encode(example.report);
    const auto whole = decode_all(stream).all<Range>();
    ASSERT_EQ(whole.size(), 3u * 3 + 2u * 4);
    for (std::size_t cut = 0; cut <= stream.size(); ++cut) {
        const auto decoder = test::default_decoder("trek1000");
        Collector sink;
        decoder->decode(test::bytes_packet(std::string_view(stream).substr(0, cut)), sink);
        decoder->decode(test::bytes_packet(std::string_view(stream).substr(cut)), sink);
        const auto ranges = sink.all<Range>();
        ASSERT_EQ(ranges.size(), whole.size()) << cut;
        for (std::size_t i = 0; i < whole.size(); ++i) ASSERT_EQ(ranges[i].range_m, whole[i].range_m) << cut;
    }
}

TEST(Trek1000, ResetForgetsTheHalfLine) {
    const auto decoder = test::default_decoder("trek1000");
    Collector sink;
    decoder->decode(test::bytes_packet("mc 07 000004ec "), sink);
    decoder->reset();
    decoder->decode(test::bytes_packet("000008ee 0000087e 00000000 6cc0 0a 00a0642b a0:0\r\n"), sink);
    EXPECT_TRUE(sink.items.empty());
}

} // namespace
} // namespace locus::uwb
