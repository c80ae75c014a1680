#include "drivers/gnss/rinex_record.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace locus::gnss::rinex {
namespace {

constexpr double day_s = 86400, metres = 1e3; // GLONASS is told in kilometres
constexpr double gps_sent_before_s = 7200;    // IS-GPS-200, 20.3.4.5: toe is the middle of four hours

/// A number that has to be there. Its place counts from 0.
class Needed {
  public:
    Needed(Values values, std::string& error) : values_{values}, error_{error} {}

    double operator[](std::size_t place) const {
        const auto value = place < values_.size() ? values_[place] : std::nullopt;
        if (value) return *value;
        if (error_.empty()) error_ = "number " + std::to_string(place + 1) + " of the record is missing";
        return 0;
    }

    template <class T>
    T whole(std::size_t place) const {
        const double value = (*this)[place];
        const bool fits = value == std::floor(value) && value >= std::numeric_limits<T>::min() &&
                          value <= std::numeric_limits<T>::max();
        if (fits) return static_cast<T>(value);
        if (error_.empty())
            error_ = "number " + std::to_string(place + 1) + " of the record has no whole value it could have";
        return 0;
    }

  private:
    Values values_;
    std::string& error_;
};

double told(Values values, std::size_t place, double otherwise) {
    return place < values.size() ? values[place].value_or(otherwise) : otherwise;
}

/// IS-GPS-200, 20.3.3.3.1.3: upper ends of the ranges; writers print either these or the nominal values inside.
std::uint8_t gps_accuracy(double range_error_m) {
    constexpr std::array upper_m{2.4, 3.4,  4.85, 6.85, 9.65,  13.65, 24.,  48.,
                                 96., 192., 384., 768., 1536., 3072., 6144.};
    return static_cast<std::uint8_t>(std::ranges::lower_bound(upper_m, range_error_m) - upper_m.begin());
}

/// Galileo OS SIS ICD 2.1, table 89.
std::uint8_t galileo_accuracy(double error_m) {
    constexpr double no_prediction = 255;
    double index = no_prediction;
    if (error_m >= 0 && error_m < 0.5) index = error_m / 0.01;
    if (error_m >= 0.5 && error_m < 1) index = 50 + (error_m - 0.5) / 0.02;
    if (error_m >= 1 && error_m < 2) index = 75 + (error_m - 1) / 0.04;
    if (error_m >= 2 && error_m <= 6) index = 100 + (error_m - 2) / 0.16;
    return static_cast<std::uint8_t>(std::lround(index));
}

/// RINEX counts E1B DVS, E1B HS (2 bits), E5a DVS, E5a HS (2), E5b DVS, E5b HS (2) from the lowest bit on.
std::uint8_t galileo_health(unsigned printed) {
    const unsigned e1b_data = printed & 1, e1b = printed >> 1 & 3, e5b_data = printed >> 6 & 1, e5b = printed >> 7 & 3;
    return static_cast<std::uint8_t>(e5b << 4 | e1b << 2 | e5b_data << 1 | e1b_data);
}

/// Data sources of a Galileo record: bit 1 is F/NAV, bits 0 and 2 are I/NAV.
bool is_fnav(double sources) { return (static_cast<unsigned>(std::clamp(sources, 0., 1023.)) & 7) == 2; }

void read_ellipse(const Needed& values, KeplerEphemeris& e) {
    e.clock_s = values[0], e.clock_drift = values[1], e.clock_drift_rate_per_s = values[2];
    e.issue = values.whole<std::uint16_t>(3);
    e.crs_m = values[4], e.mean_motion_difference = values[5], e.mean_anomaly = values[6];
    e.cuc = values[7], e.eccentricity = values[8], e.cus = values[9], e.root_a = values[10];
    e.toe_s = values[11], e.cic = values[12], e.node = values[13], e.cis = values[14];
    e.inclination = values[15], e.crc_m = values[16], e.perigee = values[17], e.node_rate = values[18];
    e.inclination_rate = values[19];
    e.group_delay_s[0] = values[25];
}

void read_rest(const Needed& values, Values all, KeplerEphemeris& e) {
    switch (e.constellation) {
    case constellation::galileo:
        e.issue_clock = e.issue;
        e.accuracy = galileo_accuracy(told(all, 23, -1));
        e.health = galileo_health(values.whole<std::uint16_t>(24));
        e.group_delay_s[1] = values[26];
        break;
    case constellation::beidou:
        e.issue_clock = values.whole<std::uint16_t>(28);
        e.accuracy = gps_accuracy(values[23]);
        e.health = values.whole<std::uint8_t>(24);
        e.group_delay_s[1] = values[26];
        break;
    default:
        e.issue_clock = values.whole<std::uint16_t>(26);
        e.accuracy = gps_accuracy(values[23]);
        e.health = values.whole<std::uint8_t>(24);
    }
}

/// In GPS time, from the constellation's own.
GpsTime in_gps_time(std::uint8_t constellation, const GpsTime& own) {
    return constellation == constellation::beidou ? own + gps_minus_beidou_s : own;
}

/// Week of the reference time as the constellation counts it.
int own_week(std::uint8_t constellation, int gps_week) {
    if (constellation == constellation::galileo) return gps_week - galileo_week_ahead;
    return constellation == constellation::beidou ? gps_week - beidou_week_ahead : gps_week;
}

/// Within half a week of the reference time; files write 0.9999E9 for a time that is not known.
GpsTime sent_at(const KeplerEphemeris& e, const GpsTime& reference, Values values) {
    const bool gps = e.constellation == constellation::gps || e.constellation == constellation::qzss;
    const double second = told(values, 27, 1e9);
    const double before_s = std::abs(second) <= 2 * week_s ? std::remainder(reference.second - second, week_s) : 1e9;
    const bool plausible = std::abs(before_s) <= day_s;
    return in_gps_time(e.constellation, reference + -(plausible ? before_s : gps ? gps_sent_before_s : 0));
}

std::optional<NavigationRecord> ellipse(const Satellite& satellite, const CivilTime& date, Values values,
                                        std::string& error) {
    const auto clock_reference = gps_time(date);
    if (!clock_reference) {
        error = "its time is no date";
        return std::nullopt;
    }
    if (!error.empty() || (satellite.constellation == constellation::galileo && is_fnav(told(values, 20, 0))))
        return {};
    const Needed needed{values, error};
    KeplerEphemeris e;
    e.constellation = satellite.constellation;
    e.satellite = satellite.number;
    read_ellipse(needed, e);
    read_rest(needed, values, e);
    if (!(e.toe_s >= 0 && e.toe_s < week_s)) error = "its time of ephemeris lies in no week";
    if (!error.empty()) return std::nullopt;
    e.toc_s = clock_reference->second;
    const GpsTime reference{week_of(e.toe_s, *clock_reference), e.toe_s};
    e.week = own_week(e.constellation, reference.week);
    return NavigationRecord{e, sent_at(e, reference, values), leap_seconds(date)};
}

std::optional<NavigationRecord> glonass(const Satellite& satellite, const CivilTime& date, Values all,
                                        std::string& error) {
    constexpr double moscow_minus_utc_s = 3 * 3600;
    const auto reference = gps_time_of_utc(date);
    if (!reference) {
        error = "its time is no date";
        return std::nullopt;
    }
    const Needed values{all, error};
    GlonassEphemeris e;
    e.satellite = satellite.number;
    e.reference = *reference;
    e.clock_s = values[0], e.clock_drift = values[1];
    for (std::size_t axis = 0; axis < 3; ++axis) {
        e.position_m[axis] = values[3 + 4 * axis] * metres;
        e.velocity_mps[axis] = values[4 + 4 * axis] * metres;
        e.acceleration_mps2[axis] = values[5 + 4 * axis] * metres;
    }
    e.health = values[6] != 0;
    e.frequency = values.whole<std::int8_t>(10);
    e.age_days = values.whole<std::uint8_t>(14);
    if (error.empty() && (e.frequency < -7 || e.frequency > 6)) error = "its frequency number is none of -7 to 6";
    if (!error.empty()) return std::nullopt;
    // Second of the day (version 2) or of the week (version 3) in UTC, on the day that brings it closest.
    const int leap_s = leap_seconds(date);
    const double ahead_s = std::remainder(values[2] + leap_s - reference->second, day_s);
    const double moscow_s = std::fmod(reference->second - leap_s + ahead_s + moscow_minus_utc_s + week_s, day_s);
    e.frame_s_in_day = moscow_s;
    return NavigationRecord{e, *reference + ahead_s, leap_s};
}

} // namespace

std::optional<NavigationRecord> record_of(const Satellite& satellite, const CivilTime& reference, Values values,
                                          std::string& error) {
    if (satellite.constellation == constellation::sbas) return std::nullopt;
    if (satellite.constellation == constellation::glonass) return glonass(satellite, reference, values, error);
    return ellipse(satellite, reference, values, error);
}

} // namespace locus::gnss::rinex
