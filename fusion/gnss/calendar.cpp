#include "fusion/gnss/calendar.h"

#include <algorithm>
#include <array>
#include <chrono>

namespace locus::gnss {
namespace {

using namespace std::chrono;

constexpr sys_days gps_begin = 1980y / January / 6;

/// From these days on UTC is one second further behind GPS time. The list that Debian's tzdata carries
/// (/usr/share/zoneinfo/leap-seconds.list) is compared with this one in the tests.
constexpr std::array<sys_days, 18> leaps{
    sys_days{1981y / July / 1},    sys_days{1982y / July / 1},    sys_days{1983y / July / 1},
    sys_days{1985y / July / 1},    sys_days{1988y / January / 1}, sys_days{1990y / January / 1},
    sys_days{1991y / January / 1}, sys_days{1992y / July / 1},    sys_days{1993y / July / 1},
    sys_days{1994y / July / 1},    sys_days{1996y / January / 1}, sys_days{1997y / July / 1},
    sys_days{1999y / January / 1}, sys_days{2006y / January / 1}, sys_days{2009y / January / 1},
    sys_days{2012y / July / 1},    sys_days{2015y / July / 1},    sys_days{2017y / January / 1}};

year_month_day ymd(const CivilTime& date) {
    return {year{date.year}, month{static_cast<unsigned>(date.month)}, day{static_cast<unsigned>(date.day)}};
}

bool is_date(const CivilTime& date) {
    return date.year >= 1980 && date.year <= 2200 && date.month > 0 && date.day > 0 && ymd(date).ok() &&
           sys_days{ymd(date)} >= gps_begin && date.hour >= 0 && date.hour < 24 && date.minute >= 0 &&
           date.minute < 60 && date.second >= 0 && date.second < 61;
}

} // namespace

std::optional<GpsTime> gps_time(const CivilTime& date) {
    if (!is_date(date)) return std::nullopt;
    const auto since = (sys_days{ymd(date)} - gps_begin).count();
    const GpsTime midnight{static_cast<int>(since / 7), static_cast<double>(since % 7) * 86400};
    return midnight + (date.hour * 3600 + date.minute * 60 + date.second);
}

std::optional<GpsTime> gps_time_of_utc(const CivilTime& date) {
    const auto time = gps_time(date);
    return time ? std::optional{*time + leap_seconds(date)} : std::nullopt;
}

int leap_seconds(const CivilTime& date) {
    if (!ymd(date).ok()) return 0;
    return static_cast<int>(std::ranges::upper_bound(leaps, sys_days{ymd(date)}) - leaps.begin());
}

} // namespace locus::gnss
