#include "drivers/layout/dbc_signal.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>
#include <cmath>

namespace locus::layout {
namespace {

TEST(DbcSignal, CountsBitsAsDbcFilesDo) {
    std::array<std::uint8_t, 8> data{};
    BitField{.start = 7, .length = 12, .motorola = true}.write(data, 0xABC);
    EXPECT_EQ(data[0], 0xAB);
    EXPECT_EQ(data[1], 0xC0);
    data = {};
    BitField{.start = 4, .length = 12}.write(data, 0xABC);
    EXPECT_EQ(data[0], 0xC0);
    EXPECT_EQ(data[1], 0xAB);
}

TEST(DbcSignal, SaysHowLongAFrameMustBe) {
    EXPECT_EQ((BitField{.start = 0, .length = 8}.bytes_needed()), 1u);
    EXPECT_EQ((BitField{.start = 7, .length = 9}.bytes_needed()), 2u);
    EXPECT_EQ((BitField{.start = 7, .length = 9, .motorola = true}.bytes_needed()), 2u);
    EXPECT_EQ((BitField{.start = 6, .length = 15, .motorola = true}.bytes_needed()), 2u);
}

TEST(DbcSignal, WhatIsWrittenIsReadAndNothingElseTouched) {
    rc::check([](std::uint64_t raw, bool motorola) {
        BitField field;
        field.length = *rc::gen::inRange(1u, 65u);
        field.start = *rc::gen::inRange(0u, 128u);
        field.motorola = motorola;
        raw &= field.length == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << field.length) - 1;
        std::array<std::uint8_t, 32> zeros{}, ones{};
        ones.fill(0xFF);
        RC_PRE(field.bytes_needed() <= zeros.size());
        field.write(zeros, raw);
        field.write(ones, raw);
        RC_ASSERT(field.read(zeros) == raw);
        RC_ASSERT(field.read(ones) == raw);
        field.write(zeros, 0);
        RC_ASSERT((zeros == std::array<std::uint8_t, 32>{}));
    });
}

TEST(DbcSignal, ValuesOfEachType) {
    EXPECT_EQ(value_of(0xFFF, 12, "signed"), -1);
    EXPECT_EQ(value_of(0xFFF, 12, "unsigned"), 4095);
    EXPECT_EQ(value_of(0x40490FDB, 32, "float"), std::bit_cast<float>(0x40490FDBu));
    EXPECT_EQ(raw_of(-1, 12, "signed"), 0xFFFu);
    EXPECT_EQ(raw_of(-5000, 12, "signed"), 0x800u) << "held to the lowest";
    EXPECT_EQ(raw_of(1e30, 12, "unsigned"), 0xFFFu) << "held to the highest";
    EXPECT_EQ(value_of(raw_of(0.1, 64, "double"), 64, "double"), 0.1);
}

} // namespace
} // namespace locus::layout
