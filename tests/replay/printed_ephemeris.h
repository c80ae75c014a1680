// Ephemerides as the numbers of a RINEX navigation record, in its order; what is no part of them is NaN.
#pragma once

#include "fusion/gnss/ephemeris_collector.h"
#include "tests/replay/rinex_oracle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace locus::test {

inline std::vector<double> as_printed(const gnss::KeplerEphemeris& e) {
    constexpr double skip = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> numbers{e.clock_s,
                                e.clock_drift,
                                e.clock_drift_rate_per_s,
                                static_cast<double>(e.issue),
                                e.crs_m,
                                e.mean_motion_difference,
                                e.mean_anomaly,
                                e.cuc,
                                e.eccentricity,
                                e.cus,
                                e.root_a,
                                e.toe_s,
                                e.cic,
                                e.node,
                                e.cis,
                                e.inclination,
                                e.crc_m,
                                e.perigee,
                                e.node_rate,
                                e.inclination_rate,
                                skip};
    const bool lnav = e.constellation != constellation::beidou;
    numbers.push_back(e.week);
    numbers.insert(numbers.end(), {skip, skip, static_cast<double>(e.health), e.group_delay_s[0]});
    numbers.push_back(lnav ? e.issue_clock : e.group_delay_s[1]);
    return numbers;
}

inline std::vector<double> as_printed(const gnss::GlonassEphemeris& e) {
    std::vector<double> numbers{e.clock_s, e.clock_drift, std::numeric_limits<double>::quiet_NaN()};
    const std::array<double, 3> ends{double(e.health), double(e.frequency), double(e.age_days)};
    for (std::size_t i = 0; i < 3; ++i)
        numbers.insert(numbers.end(),
                       {e.position_m[i] / 1e3, e.velocity_mps[i] / 1e3, e.acceleration_mps2[i] / 1e3, ends[i]});
    return numbers;
}

/// Numbers that the receivers of many stations keep in single precision: rates, group delays of
/// BeiDou. What they print differs from what was broadcast by that, some millionths of a step.
inline bool kept_in_single_precision(std::size_t number) {
    return number == 5 || number == 18 || number == 19 || number == 25 || number == 26;
}

/// Every number to the last digit that is printed. `of_station`: single precision is put up with.
inline void expect_same(const std::string& name, const gnss::Ephemeris& ephemeris, const std::vector<Printed>& record,
                        bool of_station = false) {
    const auto numbers = std::visit([](const auto& e) { return as_printed(e); }, ephemeris);
    ASSERT_GE(record.size(), numbers.size()) << name;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const bool single = of_station && kept_in_single_precision(i) &&
                            std::abs(numbers[i] - record[i].value) <= std::ldexp(std::abs(numbers[i]), -24);
        EXPECT_TRUE(std::isnan(numbers[i]) || record[i].is(numbers[i]) || single)
            << name << ", number " << i << ": " << numbers[i] << ", printed " << record[i].value;
    }
}

} // namespace locus::test
