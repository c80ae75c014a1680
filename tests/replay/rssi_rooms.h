// Rooms with three transmitters of ZigBee, BLE and WiFi each (zigbee_ble_wifi_rssi_fp): maps and test points.
#pragma once

#include "fusion/radio/radio_map.h"
#include "tests/replay/data.h"

#include <Eigen/Core>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace locus::test {

struct RssiRoom {
    struct Visit {
        Eigen::Vector2d position_site_m;
        std::vector<radio::Reading> fingerprint;
    };
    radio::RadioMap map;
    std::vector<Visit> visits;
};

/// Rows of a file: a point's number (in the tests' files), x, y, and the three strengths without their sign.
inline std::vector<RssiRoom::Visit> rssi_visits(const std::filesystem::path& path, std::size_t first) {
    std::vector<RssiRoom::Visit> visits;
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        std::vector<double> row;
        std::istringstream fields(line);
        for (std::string field; std::getline(fields, field, ',');) row.push_back(std::strtod(field.c_str(), nullptr));
        if (row.size() < first + 5) continue;
        auto& visit = visits.emplace_back();
        visit.position_site_m = {row[first], row[first + 1]};
        for (std::size_t beacon = 0; beacon < 3; ++beacon)
            visit.fingerprint.push_back({address(beacon), -row[first + 2 + beacon]});
    }
    return visits;
}

inline radio::RadioMap rssi_map(const std::vector<RssiRoom::Visit>& visits) {
    radio::RadioMap map;
    for (const auto& visit : visits) {
        auto& point = map.points.emplace_back();
        point.position_site_m = {visit.position_site_m.x(), visit.position_site_m.y(), 0};
        for (const auto& reading : visit.fingerprint) point.heard.push_back({reading.beacon, reading.rssi_dbm, 0, 1});
    }
    return map;
}

inline RssiRoom rssi_room(const std::filesystem::path& folder, int scenario, const std::string& radio) {
    const auto place = folder / ("Scenario" + std::to_string(scenario));
    const auto ending = "_Scenario" + std::to_string(scenario) + "_" + radio + ".csv";
    return {rssi_map(rssi_visits(place / ("Database" + ending), 0)), rssi_visits(place / ("Tests" + ending), 1)};
}

} // namespace locus::test
