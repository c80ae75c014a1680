// Dates in GPS time; the table of leap seconds is that of the system.
#include "fusion/gnss/calendar.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <sstream>

namespace locus::gnss {
namespace {

TEST(Calendar, DatesAreWeeksAndSeconds) {
    EXPECT_EQ(gps_time({1980, 1, 6, 0, 0, 0}), (GpsTime{0, 0}));
    EXPECT_EQ(gps_time({2019, 4, 28, 12, 44, 33.997}), (GpsTime{2051, 45873.997}));
    EXPECT_EQ(gps_time_of_utc({2019, 4, 27, 23, 59, 50}), (GpsTime{2051, 8})) << "over the week's end";
    EXPECT_EQ(gps_time_of_utc({2016, 12, 31, 23, 59, 60.5}), (GpsTime{1930, 17.5})) << "inside a leap second";
    EXPECT_EQ(gps_time_of_utc({2017, 1, 1, 0, 0, 0}), (GpsTime{1930, 18}));
}

TEST(Calendar, WhatIsNoDateHasNoTime) {
    for (const CivilTime& wrong :
         {CivilTime{1980, 1, 5, 0, 0, 0}, CivilTime{2019, 2, 29, 0, 0, 0}, CivilTime{2019, 13, 1, 0, 0, 0},
          CivilTime{2019, 0, 1, 0, 0, 0}, CivilTime{2019, 1, -1, 0, 0, 0}, CivilTime{2019, 1, 1, 24, 0, 0},
          CivilTime{2019, 1, 1, 0, 60, 0}, CivilTime{2019, 1, 1, 0, 0, 61}, CivilTime{2019, 1, 1, 0, 0, -1},
          CivilTime{90000, 1, 1, 0, 0, 0}, CivilTime{}})
        EXPECT_FALSE(gps_time(wrong) || gps_time_of_utc(wrong)) << wrong.year << ' ' << wrong.month;
    EXPECT_EQ(leap_seconds({2019, 77, 77, 0, 0, 0}), 0);
}

/// Lines of "seconds since 1900, TAI - UTC, # day month year"; GPS time is 19 s behind TAI.
TEST(Calendar, LeapSecondsAreTheSystems) {
    std::ifstream file("/usr/share/zoneinfo/leap-seconds.list");
    if (!file) GTEST_SKIP() << "no leap-seconds.list: apt install tzdata";
    std::size_t compared = 0;
    for (std::string line; std::getline(file, line);) {
        std::istringstream fields(line);
        long long since_1900_s = 0;
        int tai_minus_utc = 0;
        if (line.starts_with('#') || !(fields >> since_1900_s >> tai_minus_utc) || tai_minus_utc <= 19) continue;
        const std::chrono::sys_days day{std::chrono::year{1900} / 1 / 1};
        const std::chrono::year_month_day date{day + std::chrono::days{since_1900_s / 86400}};
        const CivilTime on{static_cast<int>(date.year()), static_cast<int>(static_cast<unsigned>(date.month())),
                           static_cast<int>(static_cast<unsigned>(date.day()))};
        EXPECT_EQ(leap_seconds(on), tai_minus_utc - 19) << line;
        ++compared;
    }
    EXPECT_EQ(compared, 18u);
    EXPECT_EQ(leap_seconds({2016, 12, 31}), 17);
}

} // namespace
} // namespace locus::gnss
