// Recorded paths of a monocular SLAM and of motion capture (evo_trajectories), and the ranges that four anchors of a
// room round them would have heard, simulated from the captured truth.
#pragma once

#include "fusion/estimators/estimator.h"
#include "fusion/geometry/vector.h"
#include "fusion/measurement.h"
#include "fusion/site.h"
#include "tests/replay/data.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <sstream>
#include <vector>

namespace locus::slam {

struct Place {
    double time_s = 0; ///< since the path's first
    Eigen::Vector3d position;
    Eigen::Quaterniond turn;
};
using Path = std::vector<Place>;

/// Lines `t x y z qx qy qz qw`; `begin_s` is taken off their times.
inline Path path(const std::filesystem::path& file, std::optional<double>& begin_s) {
    Path all;
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream numbers(line);
        Place place;
        Eigen::Vector3d p;
        Eigen::Vector4d q;
        if (!(numbers >> place.time_s >> p.x() >> p.y() >> p.z() >> q.x() >> q.y() >> q.z() >> q.w())) continue;
        if (!begin_s) begin_s = place.time_s;
        place.time_s -= *begin_s;
        place.position = p;
        place.turn = Eigen::Quaterniond(q);
        all.push_back(place);
    }
    return all;
}

/// Key frames and truth of one recording, in seconds from the first key frame on.
struct Recording {
    Path key_frames, truth;
};
inline std::optional<Recording> recording(const std::string& key_frames, const std::string& truth) {
    const auto folder = test::recorded("evo_trajectories");
    if (!folder) return {};
    std::optional<double> begin_s;
    Recording both;
    both.key_frames = path(*folder / key_frames, begin_s);
    both.truth = path(*folder / truth, begin_s);
    return both;
}

/// Between two captured places by a straight line; empty where they are further apart than `longest_gap_s`.
inline std::optional<Eigen::Vector3d> at(const Path& truth, double time_s, double longest_gap_s) {
    const auto after = std::lower_bound(truth.begin(), truth.end(), time_s,
                                        [](const Place& place, double t) { return place.time_s < t; });
    if (after == truth.begin() || after == truth.end()) return {};
    const Place& before = *(after - 1);
    const double gap_s = after->time_s - before.time_s;
    if (gap_s > longest_gap_s) return {};
    return before.position + (time_s - before.time_s) / gap_s * (after->position - before.position);
}

/// What Umeyama's fit makes of key frames from..to against the truth: the scale that is asked for.
inline double scale_to_truth(const Recording& recording, double from_s, double to_s, double longest_gap_s) {
    std::vector<Eigen::Vector3d> seen, true_m;
    for (const Place& place : recording.key_frames) {
        const auto there_m = at(recording.truth, place.time_s, longest_gap_s);
        if (!there_m || place.time_s < from_s || place.time_s > to_s) continue;
        seen.push_back(place.position);
        true_m.push_back(*there_m);
    }
    const auto columns = static_cast<Eigen::Index>(seen.size());
    const Eigen::Map<const Eigen::Matrix3Xd> from(seen.front().data(), 3, columns),
        to(true_m.front().data(), 3, columns);
    return std::cbrt(Eigen::umeyama(from, to, true).topLeftCorner<3, 3>().determinant());
}

/// A room round the path: anchors in four corners, high and low by turns.
inline Site room(const Path& truth) {
    Eigen::AlignedBox3d box;
    for (const Place& place : truth) box.extend(place.position);
    constexpr double beyond_m = 2;
    const Eigen::Vector3d low = box.min().array() - beyond_m, high = box.max().array() + beyond_m;
    Site site;
    const std::array<Vec3, 4> corners{
        {{low.x(), low.y(), 2.5}, {high.x(), low.y(), 0.3}, {high.x(), high.y(), 2.5}, {low.x(), high.y(), 0.3}}};
    for (const Vec3& corner : corners) site.anchors.push_back({"", address(site.anchors.size()), corner});
    return site;
}

inline constexpr Address tag_address = address(9), camera_address = address(1);

/// One sweep over the anchors ten times a second, white noise; none where the truth is not known.
inline std::vector<Measurement> ranges(const Recording& recording, const Site& site, double sigma_m, unsigned seed,
                                       double longest_gap_s) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(0, sigma_m);
    std::vector<Measurement> all;
    const double first_s = std::max(0.0, recording.truth.front().time_s) - 2,
                 last_s = recording.key_frames.back().time_s;
    const int epochs = static_cast<int>((last_s - first_s) * 10);
    for (int i = 0; i < epochs; ++i) {
        const double time_s = first_s + 0.1 * i;
        const auto there_m = at(recording.truth, time_s, longest_gap_s);
        for (const Anchor& anchor : site.anchors) {
            const double error_m = noise(random);
            if (!there_m) continue;
            Range range{anchor.address, tag_address, (*there_m - vector(anchor.position_site_m)).norm() + error_m};
            range.sigma_m = static_cast<float>(sigma_m);
            all.push_back({timestamp_from_s(100 + time_s), 0, 0, range});
        }
    }
    return all;
}

/// The key frames as a camera tells them.
inline std::vector<Measurement> odometry(const Path& key_frames) {
    std::vector<Measurement> all;
    for (const Place& place : key_frames) {
        VisualOdometry seen;
        seen.camera = camera_address;
        seen.tag = tag_address;
        seen.position_odometry = {place.position.x(), place.position.y(), place.position.z()};
        seen.orientation_xyzw = {place.turn.x(), place.turn.y(), place.turn.z(), place.turn.w()};
        all.push_back({timestamp_from_s(100 + place.time_s), 0, 1, seen});
    }
    return all;
}

inline std::vector<Measurement> in_order(std::vector<Measurement> a, const std::vector<Measurement>& b) {
    a.insert(a.end(), b.begin(), b.end());
    std::stable_sort(a.begin(), a.end(), [](const Measurement& x, const Measurement& y) { return x.time < y.time; });
    return a;
}

} // namespace locus::slam
