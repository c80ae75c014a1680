#include "fusion/radio/survey.h"

#include <cmath>

namespace locus::radio {

void Survey::add(const Reading& reading, const Vec3& position_site_m) {
    const bool is_strength = reading.rssi_dbm >= weakest_dbm && reading.rssi_dbm <= strongest_dbm;
    if (!is_strength || !std::isfinite(position_site_m[0] + position_site_m[1] + position_site_m[2])) return;
    Cell& cell = cells_[{std::lround(position_site_m[0] / cell_m_), std::lround(position_site_m[1] / cell_m_)}];
    ++cell.count;
    for (std::size_t axis = 0; axis < 3; ++axis) cell.sum_m[axis] += position_site_m[axis];
    Gathered& beacon = cell.heard[reading.beacon]; // Welford 1962
    const double off_db = reading.rssi_dbm - beacon.mean_dbm;
    beacon.mean_dbm += off_db / ++beacon.count;
    beacon.squares_db2 += off_db * (reading.rssi_dbm - beacon.mean_dbm);
}

RadioMap Survey::map() const {
    RadioMap map;
    for (const auto& [place, cell] : cells_) {
        ReferencePoint& point = map.points.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis) point.position_site_m[axis] = cell.sum_m[axis] / cell.count;
        for (const auto& [beacon, heard] : cell.heard)
            point.heard.push_back({beacon, heard.mean_dbm, std::sqrt(heard.squares_db2 / heard.count), heard.count});
    }
    return map;
}

} // namespace locus::radio
