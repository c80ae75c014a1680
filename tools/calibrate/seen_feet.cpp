#include "tools/calibrate/seen_feet.h"

#include "config/file_text.h"
#include "config/map_reader.h"
#include "drivers/camera/detector.h"
#include "drivers/camera/recorded_source.h"
#include "drivers/camera/v4l2_source.h"
#include "fusion/vision/box_geometry.h"
#include "fusion/vision/tracker.h"
#include "tools/interrupt.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <stdexcept>

namespace locus::calibrate {
namespace {

/// A track and its detection have so much in common, or it is another's.
constexpr float least_overlap = 0.5F;
/// Whoever is cut off by the image's lower edge shows no feet.
constexpr float least_margin_px = 2;

std::shared_ptr<void> settings_of(const camera::DetectorRow& row, const std::string& path) {
    auto settings = row.options.make();
    std::string error;
    const auto text = path.empty() ? std::optional<std::string>("{}") : config::read_file(path, error);
    if (!text) throw std::runtime_error(path + ": " + error);
    config::Problems problems(path);
    const config::BoundOptions table[]{{row.options.rows, settings.get(), row.options.lists}};
    if (const auto tree = config::parse_yaml(*text, problems)) read_map(*tree, {"detector"}, table, problems);
    if (problems.empty() && row.options.check) {
        error = row.options.check(settings.get());
        if (!error.empty()) problems.add({}, error);
    }
    if (!problems.empty() && !path.empty()) throw std::runtime_error(to_string(problems.take().front()));
    return settings;
}

std::unique_ptr<camera::Detector> detector_of(const CameraWalkRequest& request) {
    const camera::DetectorRow* row = camera::find_detector(request.detector);
    std::string error;
    for (const auto& each : camera::detector_table()) error += (error.empty() ? "" : ", ") + std::string(each.name);
    if (!row) throw std::runtime_error("no detector is called " + request.detector + "; there are " + error);
    const auto settings = settings_of(*row, request.detector_settings);
    auto detector = row->make(settings.get(), {}, error);
    if (!detector) throw std::runtime_error(error);
    return detector;
}

std::unique_ptr<camera::FrameSource> source_of(const CameraWalkRequest& request, double start_s) {
    if (!is_device(request.frames))
        return camera::make_recorded_source({.path = request.frames, .rate_hz = request.rate_hz, .speed = 0},
                                            timestamp_from_s(start_s));
    camera::V4l2Settings settings{.path = request.frames};
    if (!request.size.empty()) {
        const Eigen::Vector2d size_px = parse_image_size(request.size);
        settings.width_px = static_cast<int>(size_px.x());
        settings.height_px = static_cast<int>(size_px.y());
    }
    return camera::make_v4l2_source(settings);
}

/// Every detection counts: whether somebody is the tagged person is told by where he walks, not by a detector's score.
vision::TrackerSettings believing() {
    vision::TrackerSettings settings;
    settings.first_score = settings.strong_score = -1e6;
    return settings;
}

/// The detection's own feet: those of the track's filter lag behind in turns, and the clock with them.
void take_feet(const std::vector<vision::Detection>& found, std::span<const vision::ImageTrack> tracks, double time_s,
               SeenFeet& seen) {
    for (const auto& track : tracks) {
        if (track.unseen_s > 0 || track.occluded || !track.feet_seen || found.empty()) continue;
        const auto his = std::ranges::max_element(
            found, {}, [&](const vision::Detection& each) { return vision::iou(each.box, track.box); });
        const vision::BoxPx& box = his->box;
        if (vision::iou(box, track.box) < least_overlap ||
            box.bottom_px() > static_cast<float>(seen.image_px.y()) - least_margin_px)
            continue;
        const double sigma_px = vision::BoxNoise{}.edge * static_cast<double>(box.height_px);
        seen.feet.push_back({time_s, track.id, {box.left_px + 0.5 * box.width_px, box.bottom_px()}, sigma_px});
    }
}

} // namespace

bool is_device(const std::string& frames) {
    std::error_code ignored;
    return std::filesystem::is_character_file(frames, ignored) || frames.starts_with("/dev/");
}

SeenFeet see_feet(const CameraWalkRequest& request, double start_s) {
    const auto detector = detector_of(request);
    const auto source = source_of(request, start_s);
    if (!source->open()) throw std::runtime_error(std::string(source->last_error()));
    vision::Tracker tracker(believing());
    SeenFeet seen;
    const double most_s = is_device(request.frames) ? request.seconds : std::numeric_limits<double>::infinity();
    if (is_device(request.frames)) tools::catch_interrupts();
    for (camera::Frame frame; !tools::interrupted();) {
        const auto status = source->next(frame, std::chrono::milliseconds{100});
        if (status == camera::FrameStatus::lost) throw std::runtime_error(std::string(source->last_error()));
        if (status == camera::FrameStatus::ended) break;
        if (status != camera::FrameStatus::frame) continue;
        seen.last_s = to_s(frame.captured.time_since_epoch());
        if (seen.frames++ == 0) seen.first_s = seen.last_s;
        seen.image_px = {frame.picture.width_px, frame.picture.height_px};
        const auto found = detector->detect(frame.picture);
        take_feet(found, tracker.update(frame.captured, found), seen.last_s, seen);
        if (seen.last_s - seen.first_s > most_s) break;
    }
    if (seen.frames == 0) throw std::runtime_error("'" + request.frames + "' gave no image");
    return seen;
}

} // namespace locus::calibrate
