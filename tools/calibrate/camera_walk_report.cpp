#include "tools/calibrate/camera_walk_report.h"

#include "tools/evaluate/statistics.h"

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace locus::calibrate {

using vision::survey::WalkFit;
using vision::survey::WalkTrouble;

namespace {

struct Spread {
    double median = 0, most = 0;
};

/// Median and 95 %.
Spread spread_of(std::vector<double> values) {
    std::ranges::sort(values);
    return {evaluate::quantile(values, 0.5), evaluate::quantile(values, 0.95)};
}

/// How well the floor is known where the person walked: standard deviation in the worst direction.
Spread known_to_m(const WalkFit& walk, const std::vector<vision::survey::SeenFoot>& feet) {
    std::vector<double> sigmas_m;
    for (const std::size_t one : walk.used) {
        const auto there = vision::foot_on_floor(walk.fit.view, {feet[one].pixel_px, Eigen::Matrix2d::Identity()});
        if (!there) continue;
        const Eigen::Matrix2d covariance_m2 = floor_covariance_m2(walk.fit, there->position_site_m);
        sigmas_m.push_back(std::sqrt(Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance_m2).eigenvalues()[1]));
    }
    return sigmas_m.empty() ? Spread{} : spread_of(std::move(sigmas_m));
}

std::string offset_text(const WalkFit& walk) {
    return fmt::format("time offset: camera's time {:+.3f} s is the time of the poses, +- {:.3f} s", walk.offset_s,
                       walk.offset_sigma_s);
}

struct WalkNumbers {
    Spread px, floor_m, known_m;
};

WalkNumbers numbers_of(const WalkFit& walk, const SeenFeet& seen) {
    std::vector<double> px, floor_m;
    for (const auto& residual : walk.fit.residuals) {
        px.push_back(residual.error_px.norm());
        floor_m.push_back(residual.floor_m);
    }
    return {spread_of(px), spread_of(floor_m), known_to_m(walk, seen.feet)};
}

} // namespace

std::string sentence_of(const WalkFit& walk, const SeenFeet& seen, const std::vector<vision::survey::PathPoint>& path,
                        const CameraWalkRequest& request) {
    switch (walk.trouble) {
    case WalkTrouble::no_pose:
        return fmt::format(
            "{} feet were seen in {} images, {} of them while there were poses (images from {:.1f} to {:.1f} "
            "s, poses from {:.1f} to {:.1f} s): is --start right, and does {} find people in these images?",
            seen.feet.size(), seen.frames, walk.matched, seen.first_s, seen.last_s, path.front().time_s,
            path.back().time_s, request.detector);
    case WalkTrouble::nobody:
        return fmt::format(
            "nobody in the images walks as the poses say: are these the poses of the person who is seen "
            "(--target), are the clocks apart by more than {} s (--search, --start), and is nothing mirrored "
            "or swapped in the site's axes? Walk alone, for two minutes",
            request.search_s);
    case WalkTrouble::no_area:
        return fmt::format(
            "the walk was too straight or too small: its places spread {:.1f} m along and {:.1f} m across (1 "
            "sigma), and {:.1f} m are needed; walk over all of the floor that the camera sees",
            walk.extent_m.x(), walk.extent_m.y(), vision::survey::least_spread_sigmas * request.pose_sigma_m);
    case WalkTrouble::not_told:
        return fmt::format(
            "the walk does not tell view and clock together (the offset only to {:.2f} s): walk longer, with "
            "turns to all sides, and stop now and then",
            walk.offset_sigma_s);
    case WalkTrouble::none:
        break;
    }
    return {};
}

std::vector<std::string> report_lines(const WalkFit& walk, const SeenFeet& seen) {
    const WalkNumbers n = numbers_of(walk, seen);
    std::vector<std::string> lines{
        fmt::format("{} feet in {} images, {} while there were poses: {} used, {} refused", seen.feet.size(),
                    seen.frames, walk.matched, walk.used.size(), walk.matched - walk.used.size()),
        offset_text(walk),
        fmt::format("residuals: median {:.1f} px and {:.2f} m, 95 % {:.1f} px and {:.2f} m", n.px.median,
                    n.floor_m.median, n.px.most, n.floor_m.most),
        fmt::format("errors are {:.2f} of what was expected, and stay alike for {:.0f} feet", walk.spread,
                    walk.correlated_feet),
        fmt::format(
            "the floor is known to {:.3f} m where the person walked (95 %: {:.3f} m); the walk spread {:.1f} x {:.1f} "
            "m (1 sigma)",
            n.known_m.median, n.known_m.most, walk.extent_m.x(), walk.extent_m.y())};
    if (const auto* camera = std::get_if<vision::Camera>(&walk.fit.view))
        lines.push_back("the camera hangs at " + position_text(camera->position_site_m(), position_sigma_m(walk.fit)));
    lines.push_back(fmt::format("add {:+.3f} s to the delay_s of a live camera's settings", -walk.offset_s));
    return lines;
}

nlohmann::json report_json(const WalkFit& walk, const SeenFeet& seen) {
    const WalkNumbers n = numbers_of(walk, seen);
    return {{"class", "CAMERA_WALK"},         {"images", seen.frames},
            {"feet", seen.feet.size()},       {"matched", walk.matched},
            {"used", walk.used.size()},       {"refused", walk.matched - walk.used.size()},
            {"offset_s", walk.offset_s},      {"offset_sigma_s", walk.offset_sigma_s},
            {"residual_px", n.px.median},     {"residual_95_px", n.px.most},
            {"residual_m", n.floor_m.median}, {"residual_95_m", n.floor_m.most},
            {"known_to_m", n.known_m.median}, {"known_to_95_m", n.known_m.most}};
}

std::vector<std::string> remarks_of(const WalkFit& walk) {
    return {fmt::format("locus calibrate camera walk: {} feet used", walk.used.size()), offset_text(walk)};
}

} // namespace locus::calibrate
