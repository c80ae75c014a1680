#include "drivers/wire/bytes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <array>

namespace locus::wire {
namespace {

template <class T>
void comes_back(T value) {
    Writer out;
    out.zeros(1).little(value).big(value);
    RC_ASSERT(little<T>(out.written(), 1) == value);
    RC_ASSERT(big<T>(out.written(), 1 + sizeof(T)) == value);
}

TEST(Bytes, WhatIsWrittenIsRead) {
    rc::check([](std::uint8_t a, std::int16_t b, std::uint32_t c, std::int64_t d, float e, double f) {
        comes_back(a), comes_back(b), comes_back(c), comes_back(d), comes_back(e), comes_back(f);
    });
}

TEST(Bytes, OddWidthsKeepTheirSign) {
    const std::array<std::uint8_t, 3> minus_two{0xFE, 0xFF, 0xFF};
    EXPECT_EQ(sign_extended(little_bytes(minus_two, 0, 3), 24), -2);
    EXPECT_EQ(big_bytes(minus_two, 0, 3), 0xFEFFFFu);
    EXPECT_EQ(sign_extended(~std::uint64_t{0}, 64), -1);
}

TEST(Bytes, PastTheEndIsZero) {
    const std::array<std::uint8_t, 3> three{1, 2, 3};
    EXPECT_EQ(little<std::uint32_t>(three, 0), 0u);
    EXPECT_EQ(big<std::uint16_t>(three, 2), 0u);
    EXPECT_EQ(big<std::uint8_t>(three, ~std::size_t{0}), 0u);
}

} // namespace
} // namespace locus::wire
