#include "drivers/recording/stamp.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <limits>

namespace locus {
namespace {

std::string written(std::int64_t ns) {
    std::string text;
    append_seconds(text, timestamp_from_ns(ns));
    return text;
}

TEST(Stamp, WritesNineDigits) {
    EXPECT_EQ(written(0), "0.000000000");
    EXPECT_EQ(written(12'000'000'345), "12.000000345");
    EXPECT_EQ(written(-1), "-0.000000001");
    EXPECT_EQ(written(std::numeric_limits<std::int64_t>::min()), "-9223372036.854775808");
}

TEST(Stamp, ReadsWhatItWrites) {
    EXPECT_TRUE(rc::check([](std::uint64_t random) {
        const auto spread = static_cast<std::int64_t>(random * 0x9E3779B97F4A7C15u);
        const std::int64_t time_ns = spread % 9'000'000'000'000'000'000;
        RC_ASSERT(parse_seconds(written(time_ns)) == timestamp_from_ns(time_ns));
    }));
}

TEST(Stamp, ReadsOtherForms) {
    EXPECT_EQ(parse_seconds("1700000000.123456"), timestamp_from_ns(1'700'000'000'123'456'000));
    EXPECT_EQ(parse_seconds("7"), timestamp_from_ns(7'000'000'000));
    EXPECT_EQ(parse_seconds("-1.5e3"), timestamp_from_ns(-1'500'000'000'000));
    EXPECT_EQ(parse_seconds("0.0000000005"), timestamp_from_ns(1));
    EXPECT_EQ(parse_seconds("0.99999999999"), timestamp_from_ns(1'000'000'000));
}

TEST(Stamp, RefusesTheRest) {
    for (const char* text : {"", "-", ".5", "1.2.3", "1,5", " 1", "1 ", "+1", "0x10", "nan", "inf", "9000000000",
                             "10000000000", "1e10", "--1", "1e", "e"})
        EXPECT_FALSE(parse_seconds(text)) << text;
}

} // namespace
} // namespace locus
