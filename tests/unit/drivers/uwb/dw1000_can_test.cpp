#include "drivers/uwb/dw1000_can.h"

#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace locus::uwb {
namespace {

using test::Collector;

Collector decode(const CanFrame& frame, const Dw1000CanSettings& settings = {}) {
    Collector sink;
    make_dw1000_can(&settings)->decode(frame.packet(timestamp_from_ns(5)), sink);
    return sink;
}

CanFrame raw(std::uint32_t id, std::uint64_t word, std::uint8_t length = 8) {
    CanFrame frame{id, length, {}};
    for (std::size_t i = 0; i < 8; ++i) frame.data[i] = static_cast<std::uint8_t>(word >> (8 * i));
    return frame;
}

bool same(float a, float b) { return a == b || (std::isnan(a) && std::isnan(b)); }

/// A power or sigma on the layout's grid, or unknown.
float on_grid(unsigned steps, double step, double first) {
    const auto code = *rc::gen::inRange(0u, steps);
    return code == 0 ? unknown_f : static_cast<float>(step * (code - 1) + first);
}

Address random_address(int offset, std::uint64_t count) {
    return address(*rc::gen::inRange<std::uint64_t>(0, count) + static_cast<std::uint64_t>(offset));
}

Dw1000CanSettings random_settings() {
    return {*rc::gen::inRange(0, 0x7C1), 16, *rc::gen::inRange(0, 65536), *rc::gen::inRange(0, 65536)};
}

LineOfSight random_line_of_sight() {
    return *rc::gen::element(LineOfSight::unknown, LineOfSight::clear, LineOfSight::blocked);
}

TEST(Dw1000Can, RangeComesBackAsItWent) {
    EXPECT_TRUE(rc::check([] {
        const auto settings = random_settings();
        Range range;
        range.tag = random_address(settings.tag_offset, 65536);
        range.anchor = random_address(settings.anchor_offset, 256);
        range.range_m = *rc::gen::inRange(0, 0xFFFFF) * 1e-3;
        range.sigma_m = on_grid(64, 0.02, 0.02);
        range.rx_power_dbm = on_grid(256, -0.5, 0);
        range.line_of_sight = random_line_of_sight();
        const auto frame = encode(range, settings, *rc::gen::inRange(0u, 16u), *rc::gen::arbitrary<unsigned>());
        RC_ASSERT(frame.has_value());
        const Collector sink = decode(*frame, settings);
        RC_ASSERT(sink.items.size() == 1u);
        const auto back = sink.all<Range>()[0];
        RC_ASSERT(back.tag == range.tag && back.anchor == range.anchor && back.range_m == range.range_m);
        RC_ASSERT(same(back.sigma_m, range.sigma_m) && same(back.rx_power_dbm, range.rx_power_dbm));
        RC_ASSERT(back.line_of_sight == range.line_of_sight && sink.items[0].time == timestamp_from_ns(5));
    }));
}

TEST(Dw1000Can, DifferenceComesBackAsItWent) {
    EXPECT_TRUE(rc::check([] {
        const auto settings = random_settings();
        RangeDifference difference;
        difference.tag = random_address(settings.tag_offset, 65536);
        difference.anchor_a = random_address(settings.anchor_offset, 256);
        difference.anchor_b = random_address(settings.anchor_offset, 256);
        difference.difference_m = *rc::gen::inRange(-0x7FFFF, 0x80000) * 1e-3;
        difference.sigma_m = on_grid(64, 0.02, 0.02);
        difference.line_of_sight = random_line_of_sight();
        const auto frame = encode(difference, settings, *rc::gen::inRange(0u, 16u), *rc::gen::arbitrary<unsigned>());
        RC_ASSERT(frame.has_value());
        const Collector sink = decode(*frame, settings);
        RC_ASSERT(sink.items.size() == 1u);
        const auto back = sink.all<RangeDifference>()[0];
        RC_ASSERT(back.tag == difference.tag && back.anchor_a == difference.anchor_a);
        RC_ASSERT(back.anchor_b == difference.anchor_b && back.difference_m == difference.difference_m);
        RC_ASSERT(same(back.sigma_m, difference.sigma_m) && back.line_of_sight == difference.line_of_sight);
    }));
}

TEST(Dw1000Can, ReadsTheExamplesOfThePage) {
    const auto range = decode({0x340, 8, {0x07, 0x00, 0x03, 0xA2, 0xC4, 0x09, 0x40, 0x14}}).all<Range>().at(0);
    EXPECT_EQ(range.tag, address(7));
    EXPECT_EQ(range.anchor, address(3));
    EXPECT_EQ(range.range_m, 2.5);
    EXPECT_FLOAT_EQ(range.rx_power_dbm, -81);
    EXPECT_FLOAT_EQ(range.sigma_m, 0.1f);
    EXPECT_EQ(range.line_of_sight, LineOfSight::clear);
    const auto difference =
        decode({0x341, 8, {0x07, 0x00, 0x01, 0x02, 0x1E, 0xFB, 0xFF, 0x23}}).all<RangeDifference>().at(0);
    EXPECT_EQ(difference.anchor_a, address(1));
    EXPECT_EQ(difference.anchor_b, address(2));
    EXPECT_EQ(difference.difference_m, -1.25);
    EXPECT_TRUE(std::isnan(difference.sigma_m));
    EXPECT_EQ(difference.line_of_sight, LineOfSight::unknown);
}

TEST(Dw1000Can, WritesTheFramesOfThePage) {
    const Range range{address(3), address(7), 2.5, 0.1f, -81.f, unknown_f, LineOfSight::clear};
    EXPECT_EQ(encode(range, {}, 0, 1)->data, (std::array<std::uint8_t, 8>{7, 0, 3, 0xA2, 0xC4, 9, 0x40, 0x14}));
    EXPECT_EQ(encode(range, {}, 2, 1)->id, 0x348u);
    const RangeDifference difference{address(1), address(2), address(7), -1.25, unknown_f, LineOfSight::unknown};
    EXPECT_EQ(encode(difference, {}, 0, 2)->data, (std::array<std::uint8_t, 8>{7, 0, 1, 2, 0x1E, 0xFB, 0xFF, 0x23}));
    EXPECT_EQ(encode(difference, {}, 1, 2)->id, 0x345u);
}

TEST(Dw1000Can, FramesThatSayNoneAreUnderstoodButMeasureNothing) {
    for (const auto& frame : {raw(0x340, std::uint64_t{0xFFFFF} << 32), raw(0x341, std::uint64_t{0x80000} << 32)}) {
        const Collector sink = decode(frame);
        EXPECT_EQ(sink.frames, 1);
        EXPECT_TRUE(sink.items.empty() && sink.refusals.empty());
    }
}

TEST(Dw1000Can, LooksOnlyAtItsOwnIdentifiers) {
    constexpr std::uint32_t extended = 0x80000000, remote = 0x40000000, error = 0x20000000;
    for (const std::uint32_t id : {0x33Fu, 0x344u, 0u, 0x7FFu, extended | 0x340u, remote | 0x340u, error | 0x340u}) {
        const Collector sink = decode(raw(id, 0));
        EXPECT_TRUE(sink.frames == 0 && sink.items.empty() && sink.refusals.empty()) << id;
    }
    Dw1000CanSettings two_nodes;
    two_nodes.nodes = 2;
    EXPECT_EQ(decode(raw(0x344, 0), two_nodes).items.size(), 1u);
}

TEST(Dw1000Can, RefusesWhatIsNotOfTheLayout) {
    EXPECT_EQ(decode(raw(0x342, 0)).refusals, std::vector{Refusal::unknown_type});
    EXPECT_EQ(decode(raw(0x340, 0, 7)).refusals, std::vector{Refusal::malformed});
    EXPECT_EQ(decode(raw(0x340, 0, 0)).refusals, std::vector{Refusal::malformed});
    EXPECT_EQ(decode(raw(0x340, std::uint64_t{3} << 58)).refusals, std::vector{Refusal::malformed});
}

TEST(Dw1000Can, EncodesOnlyWhatFits) {
    const Range good{address(255), address(65535), 1048.574};
    EXPECT_TRUE(encode(good, {}, 0, 0));
    const auto refuses = [&](auto change) {
        Range range = good;
        change(range);
        return !encode(range, {}, 0, 0);
    };
    EXPECT_TRUE(refuses([](Range& r) { r.anchor = address(256); }));
    EXPECT_TRUE(refuses([](Range& r) { r.tag = address(65536); }));
    EXPECT_TRUE(refuses([](Range& r) { r.range_m = 1048.575; }));
    EXPECT_TRUE(refuses([](Range& r) { r.range_m = -0.001; }));
    EXPECT_TRUE(refuses([](Range& r) { r.range_m = std::nan(""); }));
    RangeDifference far{address(0), address(1), address(2), -524.288};
    EXPECT_FALSE(encode(far, {}, 0, 0));
    far.difference_m = -524.287;
    EXPECT_TRUE(encode(far, {}, 0, 0));
    Range below_offset = good;
    below_offset.tag = address(9);
    EXPECT_FALSE(encode(below_offset, {.tag_offset = 10}, 0, 0));
}

TEST(Dw1000Can, PowerAndSigmaAreHeldToTheLayoutsLimits) {
    Range range{address(0), address(0), 1, 50.f, -300.f};
    auto back = decode(*encode(range, {}, 0, 0)).all<Range>().at(0);
    EXPECT_FLOAT_EQ(back.sigma_m, 1.26f);
    EXPECT_FLOAT_EQ(back.rx_power_dbm, -127);
    range.sigma_m = 0;
    range.rx_power_dbm = 3;
    back = decode(*encode(range, {}, 0, 0)).all<Range>().at(0);
    EXPECT_FLOAT_EQ(back.sigma_m, 0.02f);
    EXPECT_FLOAT_EQ(back.rx_power_dbm, 0);
}

} // namespace
} // namespace locus::uwb
