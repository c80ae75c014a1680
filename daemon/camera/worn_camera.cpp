#include "daemon/camera/worn_camera.h"

#include "config/camera_calibration.h"
#include "daemon/camera/image_shape.h"
#include "drivers/clock.h"

#include <fmt/format.h>

#include <stdexcept>

namespace locus {
namespace {

constexpr Duration read_again_after = std::chrono::seconds{5};

/// No way lasts less than a second on average: so numbers that were given before a reload are not given again.
std::uint32_t fresh_segment() { return static_cast<std::uint32_t>(to_s(monotonic_now())); }

VisualOdometry measured(const camera::CameraPose& pose, std::uint32_t segment, Address camera, Address tag) {
    const Eigen::Vector3d place = pose.centre();
    const Eigen::Quaterniond turn = pose.camera_from_map.conjugate();
    return {.camera = camera,
            .segment = segment,
            .position_odometry = {place.x(), place.y(), place.z()},
            .orientation_xyzw = {turn.x(), turn.y(), turn.z(), turn.w()},
            .tag = tag};
}

} // namespace

std::optional<VisualOdometry> WornCamera::look(const camera::Frame& frame, Address camera) try {
    prepare_if_due(frame.picture);
    if (!odometer_.has_value()) return std::nullopt;
    const auto reading = odometer_.value().look(frame.picture, frame.captured);
    tell(reading);
    if (!reading.pose.has_value()) return std::nullopt;
    return measured(reading.pose.value(), reading.segment, camera, settings_.worn_by);
} catch (const std::exception& error) { // OpenCV's
    odometer_.reset();
    tried_ = monotonic_now();
    trouble_ = fmt::format("no way can be told: {}", error.what());
    return std::nullopt;
}

void WornCamera::tell(const camera::OdometerReading& reading) {
    trouble_.clear();
    if (reading.state == camera::OdometerState::starting) {
        doing_ = "odometry is starting: it needs something to see and a step to the side or ahead";
    } else if (reading.state == camera::OdometerState::tracking) {
        doing_ = fmt::format("odometry is tracking, segment {}", reading.segment);
    } else {
        doing_ = "odometry is lost";
        trouble_ = "lost its way: too little of what it had seen came back (covered, dark, a bare wall, or turned too "
                   "fast); it begins anew by itself";
    }
}

void WornCamera::prepare_if_due(const camera::Picture& picture) {
    const bool same = picture.width_px == width_px_ && picture.height_px == height_px_;
    const bool wait = odometer_.has_value() || monotonic_now() - tried_ < read_again_after;
    if (!same || !wait) prepare(picture);
}

void WornCamera::prepare(const camera::Picture& picture) {
    width_px_ = picture.width_px;
    height_px_ = picture.height_px;
    tried_ = monotonic_now();
    odometer_.reset();
    doing_.clear();
    std::vector<ConfigProblem> problems;
    const auto calibration = config::load_lens(settings_.calibration, problems);
    if (!calibration.has_value()) {
        trouble_ = problems.empty() ? "its calibration cannot be read" : to_string(problems.front());
        return;
    }
    const Eigen::Vector2d size_px(width_px_, height_px_), made_px = calibration.value().image_px;
    trouble_ = trouble_of_shape(settings_.calibration, made_px, size_px);
    if (!trouble_.empty()) return;
    odometer_.emplace(settings_.odometry, vision::scaled(calibration.value().lens, size_px.cwiseQuotient(made_px)),
                      Eigen::Vector2i(width_px_, height_px_), fresh_segment());
}

} // namespace locus
