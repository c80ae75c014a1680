#include "daemon/camera/onlooker.h"

#include "config/camera_calibration.h"
#include "daemon/camera/image_shape.h"
#include "drivers/clock.h"

#include <fmt/format.h>

#include <stdexcept>

namespace locus {
namespace {

constexpr Duration try_again_after = std::chrono::seconds{5};
/// Nobody begins a track a second for long: so numbers that were given before a reload, which the engine may still
/// know, are not given again.
std::uint32_t fresh_track_number() { return static_cast<std::uint32_t>(to_s(monotonic_now())); }

vision::BodyHeight body_of(const CameraInputSettings& settings) {
    return {settings.person_height_m, settings.person_height_sigma_m};
}

} // namespace

std::span<const vision::ImageTrack> Onlooker::look(const camera::Frame& frame) try {
    prepare_if_due(frame.picture);
    return people_.has_value() ? people_.value().look(frame) : std::span<const vision::ImageTrack>{};
} catch (const std::exception& error) { // OpenCV's: a network that does not take such pictures
    people_.reset();
    tried_ = monotonic_now();
    trouble_ = fmt::format("people cannot be looked for: {}", error.what());
    return {};
}

std::span<const FootPoint> Onlooker::feet(Address camera) {
    return people_.has_value() ? people_.value().feet(camera) : std::span<const FootPoint>{};
}

void Onlooker::prepare_if_due(const camera::Picture& picture) {
    const bool same = picture.width_px == width_px_ && picture.height_px == height_px_;
    const bool wait = people_.has_value() || monotonic_now() - tried_ < try_again_after;
    if (!same || !wait) prepare(picture);
}

void Onlooker::prepare(const camera::Picture& picture) {
    width_px_ = picture.width_px;
    height_px_ = picture.height_px;
    tried_ = monotonic_now();
    trouble_.clear();
    people_.reset();
    read_calibration(picture);
    if (!trouble_.empty()) return;
    camera::PeopleParts parts{
        .tracker = settings_.tracker, .floor = floor_, .body = body_of(settings_), .first_track = fresh_track_number()};
    parts.detector = settings_.detector->make(settings_.detector_settings.get(),
                                              camera::expected_height(floor_, parts.body), trouble_);
    if (parts.detector) people_.emplace(std::move(parts));
}

void Onlooker::read_calibration(const camera::Picture& picture) {
    floor_.reset();
    if (settings_.calibration.empty()) return;
    std::vector<ConfigProblem> problems;
    const auto calibration = config::load_camera(settings_.calibration, problems);
    if (!calibration.has_value()) {
        trouble_ = problems.empty() ? "its calibration cannot be read" : to_string(problems.front());
        return;
    }
    const Eigen::Vector2d size_px(picture.width_px, picture.height_px), made_px = calibration.value().image_px;
    trouble_ = trouble_of_shape(settings_.calibration, made_px, size_px);
    if (!trouble_.empty()) return;
    floor_ = config::view_for(calibration.value(), size_px);
}

} // namespace locus
