#include "fusion/radio/point_gaussians.h"

#include <array>
#include <cmath>
#include <limits>

namespace locus::radio {
namespace {

/// Squared, over the beacons of the map.
double difference_db2(const ReferencePoint& point, std::span<const Reading> fingerprint,
                      const std::vector<Address>& beacons, double floor_dbm) {
    double sum = 0;
    for (const Address beacon : beacons) {
        const Strength* strength = find(point, beacon);
        const auto heard = std::ranges::find(fingerprint, beacon, &Reading::beacon);
        const double here = heard == fingerprint.end() ? floor_dbm : heard->rssi_dbm;
        const double off = here - (strength != nullptr ? strength->mean_dbm : floor_dbm);
        sum += off * off;
    }
    return sum;
}

std::vector<Reading> readings_of(const ReferencePoint& point) {
    std::vector<Reading> readings;
    for (const Strength& strength : point.heard) readings.push_back({strength.beacon, strength.mean_dbm});
    return readings;
}

/// Logarithm of the chance of one point's strengths by the others'.
double log_foretold(const RadioMap& map, std::size_t left_out, const std::vector<Address>& beacons, double spread_db,
                    double floor_dbm) {
    const std::vector<Reading> fingerprint = readings_of(map.points[left_out]);
    std::vector<double> logs;
    for (std::size_t i = 0; i < map.points.size(); ++i)
        if (i != left_out)
            logs.push_back(-0.5 * difference_db2(map.points[i], fingerprint, beacons, floor_dbm) /
                           (spread_db * spread_db));
    if (logs.empty()) return 0;
    const double most = *std::ranges::max_element(logs);
    double sum = 0;
    for (const double each : logs) sum += std::exp(each - most);
    return most + std::log(sum) - static_cast<double>(beacons.size()) * std::log(spread_db);
}

} // namespace

double point_spread_db(const RadioMap& map, double floor_dbm) {
    constexpr std::array spreads_db{1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.5, 8.0, 10.0, 13.0};
    const std::vector<Address> beacons = beacons_of(map);
    double best = -std::numeric_limits<double>::infinity(), best_db = 1;
    for (const double spread_db : spreads_db) {
        double sum = 0;
        for (std::size_t i = 0; i < map.points.size(); ++i) sum += log_foretold(map, i, beacons, spread_db, floor_dbm);
        if (sum <= best) continue;
        best = sum;
        best_db = spread_db;
    }
    return best_db;
}

std::optional<Eigen::Vector2d> locate_by_points(const RadioMap& map, std::span<const Reading> fingerprint,
                                                double spread_db, double floor_dbm) {
    if (map.points.empty()) return std::nullopt;
    const std::vector<Address> beacons = beacons_of(map);
    std::vector<double> squares_db2;
    for (const ReferencePoint& point : map.points)
        squares_db2.push_back(difference_db2(point, fingerprint, beacons, floor_dbm));
    const double least = *std::ranges::min_element(squares_db2);
    Eigen::Vector2d sum(0, 0);
    double weights = 0;
    for (std::size_t i = 0; i < map.points.size(); ++i) {
        const double weight = std::exp(-0.5 * (squares_db2[i] - least) / (spread_db * spread_db));
        sum += weight * Eigen::Vector2d(map.points[i].position_site_m[0], map.points[i].position_site_m[1]);
        weights += weight;
    }
    return sum / weights;
}

} // namespace locus::radio
