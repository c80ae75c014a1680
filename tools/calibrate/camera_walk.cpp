#include "tools/calibrate/camera_walk.h"

#include "tools/calibrate/camera_walk_report.h"
#include "tools/evaluate/read.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace locus::calibrate {
namespace {

using vision::survey::WalkSettings;
using vision::survey::WalkTrouble;

/// A recording whose start nobody knows must overlap the poses for so long, or half of the shorter.
constexpr double least_overlap_s = 20;

std::vector<vision::survey::PathPoint> path_of(const CameraWalkRequest& request) {
    std::vector<vision::survey::PathPoint> path;
    for (const auto& pose : evaluate::read_estimate(request.poses, request.target))
        path.push_back({pose.time_s, pose.position_m.head<2>()});
    return path;
}

std::optional<vision::Lens> lens_for(const CameraWalkRequest& request, const Eigen::Vector2d& image_px) {
    const auto lens = lens_of_file(request.lens, "");
    if (!lens) return {};
    const Eigen::Vector2d factor = image_px.cwiseQuotient(lens->image_px);
    if (std::abs(factor.x() / factor.y() - 1) > 0.02)
        throw std::runtime_error(
            fmt::format("the lens was calibrated with images of {} x {} px, and these have {} x {}: "
                        "another part of it is shown; calibrate it at this size",
                        lens->image_px.x(), lens->image_px.y(), image_px.x(), image_px.y()));
    return vision::scaled(lens->lens, factor);
}

WalkSettings settings_for(const CameraWalkRequest& request, const SeenFeet& seen,
                          const std::vector<vision::survey::PathPoint>& path) {
    WalkSettings settings{-request.search_s, request.search_s, request.pose_sigma_m, seen.image_px};
    if (request.start_s || is_device(request.frames)) return settings;
    const double frames_s = seen.last_s - seen.first_s, poses_s = path.back().time_s - path.front().time_s;
    const double overlap_s = std::min(least_overlap_s, 0.5 * std::min(frames_s, poses_s));
    settings.least_offset_s = overlap_s - frames_s;
    settings.most_offset_s = poses_s - overlap_s;
    return settings;
}

} // namespace

CameraReport calibrate_walk(const CameraWalkRequest& request) {
    const bool live = is_device(request.frames);
    std::vector<vision::survey::PathPoint> path;
    if (!live) path = path_of(request);
    const SeenFeet seen = see_feet(request, live ? 0 : request.start_s.value_or(path.front().time_s));
    if (live) path = path_of(request); // by now it is written
    const auto settings = settings_for(request, seen, path);
    const auto walk = fit_walk(seen.feet, vision::survey::TaggedPath(path), lens_for(request, seen.image_px), settings);
    if (walk.trouble != WalkTrouble::none) throw CannotTell(sentence_of(walk, seen, path, request));
    const std::string yaml = checked_yaml({walk.fit.view, seen.image_px}, remarks_of(walk));
    return {report_lines(walk, seen), report_json(walk, seen), yaml};
}

} // namespace locus::calibrate
