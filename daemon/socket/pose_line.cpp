#include "daemon/socket/pose_line.h"

#include "daemon/socket/json_text.h"
#include "drivers/recording/stamp.h"
#include "fusion/estimators/estimator.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace locus {
namespace {

/// xx, xy, xz, yy, yz, zz of the position's part of the 6 x 6.
std::array<double, 6> position_covariance(const std::array<double, 36>& c) {
    return {c[0], c[1], c[2], c[7], c[8], c[14]};
}

bool has_orientation(const std::array<double, 4>& orientation) {
    return std::ranges::any_of(orientation, [](double value) { return value != 0; });
}

void append_covariance(std::string& out, const std::array<double, 6>& covariance) {
    if (!all_finite(covariance)) return;
    out += ",\"covariance_m2\":";
    char mark = '[';
    for (const double value : covariance) {
        out += mark;
        append_general(out, value);
        mark = ',';
    }
    out += ']';
}

void append_bound(std::string& out, std::string_view key, float bound_m) {
    if (!std::isfinite(bound_m)) return;
    out += ",\"";
    out += key;
    out += "\":";
    append_fixed(out, bound_m, 4);
}

void append_estimator(std::string& out, std::uint16_t row) {
    if (row >= estimator_table().size()) return;
    out += ",\"estimator\":";
    append_text(out, estimator_table()[row].name);
}

void append_kinds(std::string& out, std::uint32_t kinds_used) {
    out += ",\"kinds_used\":[";
    const char* mark = "\"";
    for (std::size_t kind = 0; kind < observation_names.size(); ++kind) {
        if ((kinds_used >> kind & 1u) == 0) continue;
        out += mark;
        out += observation_names[kind];
        out += '"';
        mark = ",\"";
    }
    out += ']';
}

/// The number only where it is known; its bound wherever there is one.
void append_scale(std::string& out, const OdometryScale& scale) {
    if (!std::isfinite(scale.relative_sigma)) return;
    out += R"(,"odometry_scale":{)";
    if (std::isfinite(scale.metres_per_unit)) {
        out += R"("metres_per_unit":)";
        append_general(out, scale.metres_per_unit);
        out += ',';
    }
    out += R"("relative_sigma":)";
    append_general(out, double{scale.relative_sigma});
    out += '}';
}

} // namespace

bool is_publishable(const Pose& pose) {
    return pose.estimate.missing == Missing::nothing && all_finite(pose.estimate.position_site_m);
}

std::string open_pose_line(const Pose& pose, std::string_view target, std::uint32_t reset_count,
                           std::string_view class_name) {
    const Estimate& estimate = pose.estimate;
    std::string out;
    out.reserve(640);
    out += R"({"class":")";
    out += class_name;
    out += R"(","target":)";
    append_text(out, target);
    out += ",\"time\":";
    append_seconds(out, estimate.time);
    out += ",\"published\":";
    append_seconds(out, pose.published);
    append_vector(out, "position_site_m", estimate.position_site_m);
    append_vector(out, "velocity_site_mps", estimate.velocity_site_mps);
    if (has_orientation(estimate.orientation_xyzw)) append_vector(out, "orientation_xyzw", estimate.orientation_xyzw);
    append_covariance(out, position_covariance(estimate.covariance));
    append_bound(out, "horizontal_error_95_m", pose.horizontal_error_95_m);
    append_bound(out, "vertical_error_95_m", pose.vertical_error_95_m);
    append_estimator(out, pose.estimator);
    append_kinds(out, estimate.kinds_used);
    append_scale(out, estimate.odometry_scale);
    out += ",\"reset_count\":" + std::to_string(reset_count);
    return out;
}

std::string open_pose_line(const Pose& pose, const Names& names, std::uint32_t reset_count,
                           std::string_view class_name) {
    std::string out = open_pose_line(pose, names.target(pose.target), reset_count, class_name);
    const SeenAs& seen = pose.seen_as;
    if (seen.camera == no_address) return out;
    out += R"(,"seen_as":{"camera":)";
    append_text(out, names.source(SourceKind::camera, seen.camera));
    out += ",\"track\":" + std::to_string(seen.track) + ",\"confidence\":";
    append_fixed(out, seen.confidence, 3);
    out += '}';
    return out;
}

} // namespace locus
