// Time of GNSS: week and second in it, because a double holds the seconds since 1980 to a fraction of a microsecond
// only.
#pragma once

namespace locus::gnss {

inline constexpr double week_s = 604800;

struct GpsTime {
    int week = 0;
    double second = 0;

    bool operator==(const GpsTime&) const = default;
};

constexpr double operator-(const GpsTime& a, const GpsTime& b) {
    return (a.week - b.week) * week_s + (a.second - b.second);
}

constexpr GpsTime operator+(GpsTime time, double seconds) {
    time.second += seconds;
    while (time.second >= week_s) time.second -= week_s, ++time.week;
    while (time.second < 0) time.second += week_s, --time.week;
    return time;
}

/// The week nearest to `near` of those whose number modulo `modulus` is `week`: satellites tell only that.
constexpr int nearest_week(int week, int modulus, int near) {
    const int behind = ((near - week) % modulus + modulus) % modulus;
    return behind <= modulus / 2 ? near - behind : near - behind + modulus;
}

/// Week of a reference time that is given without one, and lies within half a week of when it was sent.
constexpr int week_of(double reference_s, const GpsTime& sent) {
    if (reference_s < sent.second - week_s / 2) return sent.week + 1;
    return reference_s > sent.second + week_s / 2 ? sent.week - 1 : sent.week;
}

inline constexpr int galileo_week_ahead = 1024; ///< GPS week = Galileo week + this
inline constexpr int beidou_week_ahead = 1356;
inline constexpr double gps_minus_beidou_s = 14;

} // namespace locus::gnss
