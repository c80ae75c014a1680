#include "daemon/camera/cameras.h"

#include "drivers/clock.h"
#include "drivers/recording/log_line.h"
#include "drivers/recording/measurement_json.h"

#include <fmt/format.h>

namespace locus {

std::string fingerprint_of(const CameraInputSettings& camera) {
    Settings only;
    only.cameras.push_back(camera);
    return print_settings(only);
}

RunningCamera::Body::Body(const CameraInputSettings& given, std::size_t place, LogFile* to)
    : name{given.name}, source{*given.source}, source_settings{given.source_settings},
      address{static_cast<Address>(place)}, recording{to}, log{fmt::format("camera \"{}\"", given.name)},
      onlooker{given}, device{parts()} {
    if (given.is_worn()) worn.emplace(given);
}

camera::CameraParts RunningCamera::Body::parts() {
    camera::CameraParts parts;
    parts.source = source.make(source_settings.get());
    parts.on_frame = [this](const camera::Frame& frame) { see(frame); };
    parts.on_event = [this](const InputEvent& event) { log.tell(event); };
    return parts;
}

/// In the camera's thread.
void RunningCamera::Body::see(const camera::Frame& frame) {
    InputStatus& status = device.status();
    status.bytes += frame.picture.pixels.size();
    if (worn.has_value())
        find_way(frame);
    else
        find_people(frame);
}

void RunningCamera::Body::find_people(const camera::Frame& frame) {
    const auto tracks = onlooker.look(frame);
    tell_trouble(onlooker.trouble());
    for (const FootPoint& foot : onlooker.feet(address)) give(foot, frame.captured);
    show(frame, tracks);
}

void RunningCamera::Body::find_way(const camera::Frame& frame) {
    WornCamera& eye = worn.value(); // NOLINT(bugprone-unchecked-optional-access): see() asked
    const auto odometry = eye.look(frame, address);
    device.status().doing.set(eye.doing());
    tell_trouble(eye.trouble());
    if (odometry.has_value()) give(odometry.value(), frame.captured);
    show(frame, {});
}

/// Whoever asked is told after a while that nothing came.
void RunningCamera::Body::show(const camera::Frame& frame, std::span<const vision::ImageTrack> tracks) try {
    const auto names = view.asked();
    if (!names.has_value()) return;
    camera::Picture picture = frame.picture;
    camera::annotate(picture, tracks, names.value(), onlooker.floor());
    view.show(camera::to_jpeg(picture));
} catch (const std::exception& error) {
    log.tell({InputEvent::Kind::trouble, fmt::format("cannot be shown: {}", error.what())});
}

/// A recording gets it as a line of bytes, stamped when it came, as if a device had sent it.
void RunningCamera::Body::give(const Observation& observation, Timestamp time) {
    const Measurement measurement{time, sequence++, 0, observation};
    ++device.status().measurements;
    if (!ring.push(measurement)) ++device.status().ring_dropped;
    if (recording == nullptr) return;
    const std::string text = to_json_line(measurement) + "\n";
    Packet packet;
    packet.time = monotonic_now();
    packet.data = {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}; // NOLINT(*-reinterpret-cast): text
    recording->write_line(to_log_line(name, packet));
}

void RunningCamera::Body::tell_trouble(const std::string& trouble) {
    if (trouble == told) return;
    told = trouble;
    InputStatus& status = device.status();
    status.trouble.set(told);
    if (!told.empty()) {
        status.last_error.set(told);
        status.last_error_ns = to_ns(monotonic_now());
    }
    log.tell({InputEvent::Kind::trouble, told});
}

RunningCamera::RunningCamera(const CameraInputSettings& settings, std::size_t place, LogFile* recording)
    : body_{std::make_shared<Body>(settings, place, recording)}, thread_{[body = body_](const std::stop_token& stop) {
          name_this_thread(body->name);
          body->device.run(stop);
      }} {}

std::vector<InputEntry> entries(const CameraSet& cameras) {
    std::vector<InputEntry> entries;
    for (const auto& [settings, fingerprint, running] : cameras.slots())
        entries.push_back({settings.name, std::string{settings.source->name},
                           settings.is_worn() ? "odometry" : std::string{settings.detector->name},
                           running ? running->status() : nullptr, running ? running->view() : nullptr});
    return entries;
}

} // namespace locus
