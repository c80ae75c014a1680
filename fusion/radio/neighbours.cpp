#include "fusion/radio/neighbours.h"

#include <cmath>
#include <utility>

namespace locus::radio {
namespace {

using Ranked = std::pair<double, const ReferencePoint*>; ///< distance in dB

double squared(double x) { return x * x; }

const Reading* reading_of(std::span<const Reading> fingerprint, Address beacon) {
    const auto found = std::ranges::find(fingerprint, beacon, &Reading::beacon);
    return found == fingerprint.end() ? nullptr : &*found;
}

/// Over the beacons that at least one side heard.
double distance_db(const ReferencePoint& point, std::span<const Reading> fingerprint, double floor_dbm) {
    double sum = 0;
    for (const Reading& reading : fingerprint) {
        const Strength* strength = find(point, reading.beacon);
        sum += squared(reading.rssi_dbm - (strength != nullptr ? strength->mean_dbm : floor_dbm));
    }
    for (const Strength& strength : point.heard)
        if (reading_of(fingerprint, strength.beacon) == nullptr) sum += squared(strength.mean_dbm - floor_dbm);
    return std::sqrt(sum);
}

bool shares_a_beacon(const RadioMap& map, std::span<const Reading> fingerprint) {
    return std::ranges::any_of(map.points, [&](const ReferencePoint& point) {
        return std::ranges::any_of(
            point.heard, [&](const Strength& strength) { return reading_of(fingerprint, strength.beacon) != nullptr; });
    });
}

Eigen::Vector2d mean_of(std::span<const Ranked> nearest, bool weighted) {
    constexpr double alike_db = 1e-3; // a point that is hit exactly does not weigh without end
    Eigen::Vector2d sum(0, 0);
    double weights = 0;
    for (const auto& [distance, point] : nearest) {
        const double weight = weighted ? 1 / (distance + alike_db) : 1;
        sum += weight * Eigen::Vector2d(point->position_site_m[0], point->position_site_m[1]);
        weights += weight;
    }
    return sum / weights;
}

} // namespace

std::optional<Eigen::Vector2d> nearest_neighbours(const RadioMap& map, std::span<const Reading> fingerprint,
                                                  const NeighbourSettings& settings, double floor_dbm) {
    if (!shares_a_beacon(map, fingerprint)) return std::nullopt;
    std::vector<Ranked> ranked;
    for (const ReferencePoint& point : map.points)
        ranked.emplace_back(distance_db(point, fingerprint, floor_dbm), &point);
    std::ranges::stable_sort(ranked, {}, &Ranked::first);
    const std::size_t count = std::clamp<std::size_t>(settings.count, 1, ranked.size());
    return mean_of(std::span(ranked).first(count), settings.weighted);
}

} // namespace locus::radio
