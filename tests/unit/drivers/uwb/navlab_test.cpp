#include "drivers/uwb/navlab.h"

#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace locus::uwb {
namespace {

using test::Collector;

Collector navlab_decoded(std::string_view text) {
    Collector sink;
    test::default_decoder("navlab")->decode(test::bytes_packet(text), sink);
    return sink;
}

/// By the layout of protocols.md 1(a); no public line of such a node was found.
constexpr std::string_view navlab_line = "0002 8000 0002 0000091d 000008f0 00000955 fffec780";

TEST(Navlab, ReadsALine) {
    const NavlabRange expected{2, 0x8000, 2, 2333, 2288, 2389, -80'000};
    EXPECT_EQ(parse_navlab_range(navlab_line), expected);
    EXPECT_EQ(encode(expected), std::string{navlab_line} + "\r\n");
    const auto ranges = navlab_decoded(encode(expected)).all<Range>();
    ASSERT_EQ(ranges.size(), 1u);
    EXPECT_EQ(ranges[0].anchor, address(0x8000));
    EXPECT_EQ(ranges[0].tag, address(2));
    EXPECT_DOUBLE_EQ(ranges[0].range_m, 2.333);
    EXPECT_FLOAT_EQ(ranges[0].rx_power_dbm, -80.f);
}

TEST(Navlab, RefusesWhatDoesNotFit) {
    for (const std::string line :
         {"0002 8000 0002 0000091d 000008f0 00000955", "0002 8000 0002 0000091d 000008f0 00000955 fffec780 1",
          "0002 8000 002 0000091d 000008f0 00000955 fffec780", "0002 8000 0002 000091d 000008f0 00000955 fffec780",
          "0002 8000 0002 0000091d  000008f0 00000955 fffec780",
          "0002 8000 0002 0000091g 000008f0 00000955 fffec780"}) {
        const Collector sink = navlab_decoded(line + "\n");
        EXPECT_EQ(sink.refusals, std::vector<Refusal>{Refusal::malformed}) << line;
        EXPECT_TRUE(sink.items.empty());
    }
    const Collector sink = navlab_decoded("0002 8000 0002 ffffffff 000008f0 00000955 fffec780\n"
                                          "0002 8000 0002 01312d01 000008f0 00000955 fffec780\n");
    EXPECT_EQ(sink.refusals, (std::vector<Refusal>{Refusal::out_of_range, Refusal::out_of_range}));
    EXPECT_TRUE(sink.items.empty());
}

TEST(Navlab, ReadsBackWhatItWrites) {
    EXPECT_TRUE(rc::check([](std::uint64_t source, std::uint16_t anchor, std::uint64_t tag, std::int32_t range,
                             std::int32_t by_power, std::int32_t raw, std::int32_t power) {
        const NavlabRange said{source, anchor, tag, range, by_power, raw, power};
        std::string line = encode(said);
        line.resize(line.size() - 2);
        RC_ASSERT(parse_navlab_range(line) == said);
    }));
}

} // namespace
} // namespace locus::uwb
