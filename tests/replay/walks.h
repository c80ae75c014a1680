// Readers of recorded walks: foot-mounted units with stance labels (pyshoe_foot_imu), hand-held phones between
// waypoints (indoor_location_competition, unpacked by gzip), and one person in a hall with anchors (isas_walk).
#pragma once

#include "fusion/measurement.h"
#include "tests/replay/data.h"

#include <Eigen/Core>

#include <cstdio>
#include <map>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

namespace locus::test {

struct TimedImu {
    Timestamp time;
    ImuSample sample;
};

/// Rows of numbers of a CSV file after its heading; fields that are no numbers read as 0.
inline std::vector<std::vector<double>> csv(const std::filesystem::path& path) {
    std::vector<std::vector<double>> rows;
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    while (std::getline(file, line)) {
        auto& row = rows.emplace_back();
        std::istringstream fields(line);
        for (std::string field; std::getline(fields, field, ',');) row.push_back(std::strtod(field.c_str(), nullptr));
    }
    return rows;
}

struct PhoneWalk {
    struct Waypoint {
        double time_s = 0;
        Eigen::Vector2d position_site_m;
    };
    std::vector<TimedImu> imu;
    std::vector<Waypoint> waypoints;

    double length_m() const {
        double sum = 0;
        for (std::size_t i = 1; i < waypoints.size(); ++i)
            sum += (waypoints[i].position_site_m - waypoints[i - 1].position_site_m).norm();
        return sum;
    }
};

/// A packed trace; accelerometer, gyroscope and magnetometer lines of one millisecond make one sample.
inline PhoneWalk phone_walk(const std::filesystem::path& path) {
    PhoneWalk walk;
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(popen(("zcat " + path.string()).c_str(), "r"), pclose);
    std::string text;
    char buffer[65536];
    for (std::size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe.get())) > 0;) text.append(buffer, n);
    std::istringstream lines(text);
    Vec3 force{};
    Vec3f field = unknown_vec3f;
    for (std::string line; std::getline(lines, line);) {
        double time_ms = 0, x = 0, y = 0, z = 0;
        char type[64];
        if (std::sscanf(line.c_str(), "%lf %63s %lf %lf %lf", &time_ms, type, &x, &y, &z) < 4) continue;
        const std::string kind = type;
        if (kind == "TYPE_ACCELEROMETER") force = {x, y, z};
        if (kind == "TYPE_MAGNETIC_FIELD")
            field = {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
        if (kind == "TYPE_WAYPOINT") walk.waypoints.push_back({time_ms / 1000, {x, y}});
        if (kind == "TYPE_GYROSCOPE" && force[2] != 0)
            walk.imu.push_back({timestamp_from_s(time_ms / 1000), {address(1), force, {x, y, z}, field}});
    }
    return walk;
}

inline std::vector<TimedImu> isas_imu(const std::filesystem::path& path) {
    std::vector<TimedImu> imu;
    for (const auto& row : csv(path))
        imu.push_back({timestamp_from_s(row[0]),
                       {address(1), {row[4], row[5], row[6]}, {row[1], row[2], row[3]}, unknown_vec3f}});
    return imu;
}

} // namespace locus::test
