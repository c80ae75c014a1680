// The recorded flights of util_uwb_tdoa as their CSV files have them. Nothing of them is copied into the project: the
// tests read them where LOCUS_DATA or ../shared/data has them and skip where it has not.
#pragma once

#include "fusion/measurement.h"
#include "fusion/site.h"
#include "tests/replay/data.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace locus::crazyflie {

using Rows = std::vector<std::vector<double>>;

struct Truth {
    double time_s = 0;
    Eigen::Vector3d antenna_site_m;
    double body_height_m = 0;
};

struct Flight {
    Site site;
    std::vector<Measurement> measurements;
    std::vector<Truth> truth;
};

inline std::optional<std::filesystem::path> folder() { return test::recorded("util_uwb_tdoa"); }

/// Rows of numbers under one line of titles.
inline Rows read_csv(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::string line;
    if (!std::getline(file, line)) throw std::runtime_error("cannot read " + path.string());
    Rows rows;
    while (std::getline(file, line)) {
        std::replace(line.begin(), line.end(), ',', ' ');
        std::istringstream numbers(line);
        rows.emplace_back();
        for (double number = 0; numbers >> number;) rows.back().push_back(number);
    }
    return rows;
}

inline Address anchor(double id) { return address(static_cast<std::uint64_t>(id)); }

inline Site read_site(const Rows& survey) {
    Site site;
    for (const auto& row : survey) site.anchors.push_back({"", anchor(row[0]), {row[1], row[2], row[3]}});
    return site;
}

/// Data README: the antenna stands at (-0.01245, 0.00127, 0.0908) m in the body's frame.
inline std::vector<Truth> read_truth(const Rows& vicon) {
    const Eigen::Vector3d antenna_body_m(-0.01245, 0.00127, 0.0908);
    std::vector<Truth> truth;
    for (const auto& row : vicon) {
        const Eigen::Quaterniond body_to_site(row[7], row[4], row[5], row[6]);
        const Eigen::Vector3d body_site_m(row[1], row[2], row[3]);
        truth.push_back({row[0], body_site_m + body_to_site.normalized() * antenna_body_m, row[3]});
    }
    return truth;
}

inline std::vector<Measurement> read_differences(const Rows& tdoa) {
    std::vector<Measurement> all;
    for (const auto& row : tdoa)
        all.push_back({timestamp_from_s(row[0]), static_cast<std::uint32_t>(all.size()), 0,
                       RangeDifference{anchor(row[1]), anchor(row[2]), anchor(0), row[3]}});
    return all;
}

inline std::vector<Measurement> read_ranges(const Rows& twr) {
    std::vector<Measurement> all;
    for (const auto& row : twr)
        all.push_back({timestamp_from_s(row[0]), static_cast<std::uint32_t>(all.size()), 0,
                       Range{anchor(row[1]), anchor(0), row[2]}});
    return all;
}

/// `survey` names the anchors' survey: "0425", "0426", "const1" ... Throws when a file cannot be read.
inline Flight load(const std::filesystem::path& folder, const std::string& flight, const std::string& survey) {
    const auto csv = folder / "csv" / flight;
    const bool two_way = std::filesystem::exists(csv / "uwb_twr.csv");
    return {read_site(read_csv(folder / "survey" / ("anchors_" + survey + "_vicon_frame.csv"))),
            two_way ? read_ranges(read_csv(csv / "uwb_twr.csv")) : read_differences(read_csv(csv / "uwb_tdoa.csv")),
            read_truth(read_csv(csv / "vicon_pose.csv"))};
}

} // namespace locus::crazyflie
