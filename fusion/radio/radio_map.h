// Radio map: how strongly each beacon is heard at places that somebody stood at (paper 003 section 2 after Bahl and
// Padmanabhan 2000). A beacon is the end of the link that does not move, whichever end sends.
#pragma once

#include "fusion/measurement.h"

#include <algorithm>
#include <string>
#include <vector>

namespace locus::radio {

struct Strength {
    Address beacon = no_address;
    double mean_dbm = 0;
    double spread_db = 0; ///< standard deviation of single readings
    int count = 1;        ///< of readings
};

struct ReferencePoint {
    Vec3 position_site_m{};
    std::vector<Strength> heard; ///< each beacon once; who is not here was not heard
};

struct RadioMap {
    std::string site, date, device;
    std::vector<ReferencePoint> points;
};

/// One reading of a fingerprint.
struct Reading {
    Address beacon = no_address;
    double rssi_dbm = 0;
};

inline constexpr std::size_t max_reference_points = 1000; ///< the cost of a Gaussian process goes with their square
inline constexpr std::size_t max_beacons = 512;
/// What radios can hear at all, with room: 802.15.4 receivers end at -110 dBm, LoRa at -148.
inline constexpr double weakest_dbm = -150, strongest_dbm = 30;

/// nullptr when it was not heard there.
inline const Strength* find(const ReferencePoint& point, Address beacon) {
    const auto found = std::find_if(point.heard.begin(), point.heard.end(),
                                    [beacon](const Strength& strength) { return strength.beacon == beacon; });
    return found == point.heard.end() ? nullptr : &*found;
}

/// Every beacon that was heard at `least` points or more, by rising address.
std::vector<Address> beacons_of(const RadioMap& map, std::size_t least = 1);

/// The weakest mean in the map: what is weaker is not heard. weakest_dbm when nothing was heard at all.
double hearing_floor_dbm(const RadioMap& map);

/// Mean distance of a point to its nearest neighbour, on the floor; 1 for a single point.
double point_spacing_m(const RadioMap& map);

/// Within which a beacon that some point heard is taken to be in reach of the others: 2.5 spacings.
double hole_reach_m(const RadioMap& map);

} // namespace locus::radio
