#include "drivers/camera/camera.h"

#include "drivers/clock.h"
#include "drivers/stoppable_sleep.h"

namespace locus::camera {
namespace {

constexpr Duration frame_timeout = std::chrono::milliseconds{100};

} // namespace

void Camera::run(const std::stop_token& stop) {
    bool ended = false;
    while (!ended && !stop.stop_requested()) {
        ended = open() && read_until_lost(stop) == FrameStatus::ended;
        if (!ended && !stop.stop_requested()) sleep_unless_stopped(stop, back_off_.next());
    }
    parts_.source->close();
    status_.state = ended ? InputState::ended : InputState::stopped;
    if (ended) tell(InputEvent::Kind::ended, {});
}

bool Camera::open() {
    if (!parts_.source->open()) {
        fail(InputEvent::Kind::unavailable, parts_.source->last_error());
        return false;
    }
    if (was_open_) ++status_.reconnects;
    was_open_ = true;
    told_.clear();
    status_.trouble.set({});
    status_.state = InputState::open;
    tell(InputEvent::Kind::opened, {});
    return true;
}

FrameStatus Camera::read_until_lost(const std::stop_token& stop) {
    FrameStatus result = FrameStatus::nothing;
    while (result != FrameStatus::lost && result != FrameStatus::ended && !stop.stop_requested()) {
        result = parts_.source->next(frame_, frame_timeout);
        copy_counters();
        if (result == FrameStatus::frame) deliver();
    }
    if (result == FrameStatus::lost) fail(InputEvent::Kind::lost, parts_.source->last_error());
    parts_.source->close();
    return result;
}

void Camera::deliver() {
    back_off_.reset(); // not at open(): a camera that opens but gives nothing and falls away must not spin
    ++status_.frames;
    ++status_.packets;
    status_.last_packet_ns.store(to_ns(frame_.captured), std::memory_order_relaxed);
    if (parts_.on_frame) parts_.on_frame(frame_);
}

void Camera::copy_counters() {
    status_.kernel_dropped.store(parts_.source->dropped(), std::memory_order_relaxed);
    status_.refused[static_cast<std::size_t>(Refusal::malformed)].store(parts_.source->damaged(),
                                                                        std::memory_order_relaxed);
    const std::string_view trouble = parts_.source->trouble();
    if (trouble == told_) return;
    note(trouble);
    tell(InputEvent::Kind::trouble, trouble);
}

void Camera::note(std::string_view text) {
    told_ = text;
    status_.trouble.set(text);
    if (text.empty()) return;
    status_.last_error.set(text);
    status_.last_error_ns = to_ns(monotonic_now());
}

void Camera::fail(InputEvent::Kind kind, std::string_view text) {
    status_.state = InputState::waiting;
    if (text == told_) return;
    note(text);
    tell(kind, text);
}

void Camera::tell(InputEvent::Kind kind, std::string_view text) const {
    if (parts_.on_event) parts_.on_event({kind, text});
}

} // namespace locus::camera
