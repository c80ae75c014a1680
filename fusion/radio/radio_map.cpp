#include "fusion/radio/radio_map.h"

#include <cmath>
#include <limits>
#include <map>

namespace locus::radio {
namespace {

double floor_distance_m(const ReferencePoint& a, const ReferencePoint& b) {
    return std::hypot(a.position_site_m[0] - b.position_site_m[0], a.position_site_m[1] - b.position_site_m[1]);
}

double nearest_other_m(const RadioMap& map, const ReferencePoint& point) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const ReferencePoint& other : map.points) {
        const double distance_m = floor_distance_m(point, other);
        if (distance_m > 0) nearest = std::min(nearest, distance_m);
    }
    return nearest;
}

} // namespace

std::vector<Address> beacons_of(const RadioMap& map, std::size_t least) {
    std::map<Address, std::size_t> points;
    for (const ReferencePoint& point : map.points)
        for (const Strength& strength : point.heard) ++points[strength.beacon];
    std::vector<Address> beacons;
    for (const auto& [beacon, count] : points)
        if (count >= least) beacons.push_back(beacon);
    return beacons;
}

double hearing_floor_dbm(const RadioMap& map) {
    double weakest = strongest_dbm;
    for (const ReferencePoint& point : map.points)
        for (const Strength& strength : point.heard) weakest = std::min(weakest, strength.mean_dbm);
    return weakest < strongest_dbm ? weakest : weakest_dbm;
}

double point_spacing_m(const RadioMap& map) {
    double sum_m = 0;
    int count = 0;
    for (const ReferencePoint& point : map.points) {
        const double distance_m = nearest_other_m(map, point);
        if (!std::isfinite(distance_m)) continue;
        sum_m += distance_m;
        ++count;
    }
    return count > 0 ? sum_m / count : 1;
}

double hole_reach_m(const RadioMap& map) {
    constexpr double spacings = 2.5;
    return spacings * point_spacing_m(map);
}

} // namespace locus::radio
