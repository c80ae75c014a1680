// Words of a file as values: addresses, numbers, texts.
#include "config/address.h"
#include "config/parse_plain.h"
#include "config/plain_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace locus::config {
namespace {

TEST(Addresses, InEveryFormThatIsPrintedOnBoards) {
    EXPECT_EQ(parse_address("0"), address(0));
    EXPECT_EQ(parse_address("4660"), address(0x1234));
    EXPECT_EQ(parse_address("0x1234"), address(0x1234));
    EXPECT_EQ(parse_address("12:34"), address(0x1234));
    EXPECT_EQ(parse_address("DE:CA:01:02:03:04:05:06"), address(0xDECA010203040506));
    EXPECT_EQ(parse_address("de-ca-01-02-03-04-05-06"), address(0xDECA010203040506));
}

TEST(Addresses, WhatIsNoneIsRefused) {
    for (const auto* text : {"", "x", "-1", "+1", " 1", "1 ", "0x", "0x1g", "12:3", "12:3g", "DE:CA:01",
                             "12:34:", "DE:CA-01:02:03:04:05:06", "18446744073709551616", "0x10000000000000000", "1e3"})
        EXPECT_EQ(parse_address(text), std::nullopt) << text;
}

TEST(Addresses, TextReadsBack) {
    EXPECT_TRUE(
        rc::check([](std::uint64_t value) { RC_ASSERT(parse_address(to_text(address(value))) == address(value)); }));
    EXPECT_EQ(to_text(address(7)), "7");
    EXPECT_EQ(to_text(address(0x1234)), "0x1234");
}

TEST(Plain, Numbers) {
    EXPECT_EQ(parse_double("-1.5e-3"), -1.5e-3);
    EXPECT_EQ(parse_double("+2"), 2.0);
    EXPECT_EQ(parse_integer("0x10"), 16);
    EXPECT_EQ(parse_integer("010"), 10);
    for (const auto* text : {"", "+", "1,5", "0x1.8p1", "nan", "inf", "1e999", "1 m", "--1", "++1"})
        EXPECT_EQ(parse_double(text), std::nullopt) << text;
    for (const auto* text : {"", "1.0", "0x", "0x-1", "9223372036854775808"})
        EXPECT_EQ(parse_integer(text), std::nullopt) << text;
}

TEST(Plain, Booleans) {
    EXPECT_EQ(parse_bool("yes"), true);
    EXPECT_EQ(parse_bool("Off"), false);
    EXPECT_EQ(parse_bool("1"), std::nullopt);
    EXPECT_EQ(parse_bool("tRUE"), std::nullopt);
}

TEST(Text, Utf8IsCheckedAsRfc3629Says) {
    for (const std::string text : {"a", "\xC3\xA9", "\xE2\x82\xAC", "\xF0\x9F\x9B\xB0"})
        EXPECT_EQ(utf8_length(text), text.size());
    for (const std::string text : {"\x80", "\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xE2\x82",
                                   "\xF8\x88\x80\x80\x80", "\xC3"})
        EXPECT_EQ(utf8_length(text), 0u);
}

TEST(Text, ShownIsCutBetweenCharacters) {
    EXPECT_EQ(shown("short\n"), "short ");
    EXPECT_EQ(shown(fmt::format("{:x<39}\xE2\x82\xAC\xE2\x82\xAC", "")), fmt::format("{:x<39}...", ""));
}

} // namespace
} // namespace locus::config
