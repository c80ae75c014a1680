#include "drivers/camera/people.h"

#include <Eigen/Core>

#include <algorithm>
#include <limits>
#include <utility>

namespace locus::camera {
namespace {

constexpr float nobody = std::numeric_limits<float>::quiet_NaN();

float height_px(const vision::Camera& camera, const Eigen::Vector2d& foot_px, double height_m) {
    const auto stands = vision::foot_on_floor(camera, {foot_px, Eigen::Matrix2d::Identity()});
    if (!stands.has_value()) return nobody;
    const Eigen::Vector2d& at = stands.value().position_site_m;
    const auto head = vision::look_at(camera, {at.x(), at.y(), height_m});
    return head.has_value() ? static_cast<float>((foot_px - head.value().pixel_px).norm()) : nobody;
}

FootPoint foot_point(const vision::ImageTrack& track, const vision::FloorPoint& at, Address camera) {
    FootPoint foot;
    foot.camera = camera;
    foot.track = track.id;
    foot.position_site_m = {at.position_site_m.x(), at.position_site_m.y()};
    foot.covariance_m2 = {static_cast<float>(at.covariance_m2(0, 0)), static_cast<float>(at.covariance_m2(0, 1)),
                          static_cast<float>(at.covariance_m2(1, 1))};
    foot.confidence = std::clamp(track.score, 0.0F, 1.0F);
    foot.looks = track.looks;
    return foot;
}

} // namespace

ExpectedHeight expected_height(const std::optional<vision::FloorView>& floor, const vision::BodyHeight& body) {
    const auto* camera = floor.has_value() ? std::get_if<vision::Camera>(&floor.value()) : nullptr;
    if (camera == nullptr) return {};
    return [camera = *camera, height_m = body.height_m](float foot_x_px, float foot_y_px) {
        return height_px(camera, {foot_x_px, foot_y_px}, height_m);
    };
}

People::People(PeopleParts parts)
    : parts_(std::move(parts)), tracker_(parts_.tracker, parts_.floor, parts_.first_track) {}

std::span<const vision::ImageTrack> People::look(const Frame& frame) {
    tracks_ = tracker_.update(frame.captured, parts_.detector->detect(frame.picture));
    return tracks_;
}

/// Whom nobody sees just now is left out: his place is a guess of the tracker, and no measurement.
std::span<const FootPoint> People::feet(Address camera) {
    feet_.clear();
    if (!parts_.floor.has_value()) return feet_;
    for (const vision::ImageTrack& track : tracks_) {
        if (track.unseen_s > 0) continue;
        const auto at = vision::stands_at(parts_.floor.value(), track, parts_.body);
        if (at.has_value()) feet_.push_back(foot_point(track, at.value(), camera));
    }
    return feet_;
}

} // namespace locus::camera
