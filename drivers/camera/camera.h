// Camera: one frame source, read by one thread of its own, each frame handed to one receiver. It opens its device,
// opens it again after every loss, for ever, and counts all that happens: what drivers/input.h is for bytes.
//
//   Camera camera{{.source = make_v4l2_source(settings), .on_frame = [&](const Frame& frame) { ... }}};
//   std::jthread thread{[&](std::stop_token stop) { camera.run(stop); }};
#pragma once

#include "drivers/back_off.h"
#include "drivers/camera/frame_source.h"
#include "drivers/input.h"

#include <functional>
#include <memory>
#include <stop_token>
#include <string>

namespace locus::camera {

struct CameraParts {
    std::unique_ptr<FrameSource> source{};
    std::function<void(const Frame&)> on_frame{};      ///< called in the camera's thread
    std::function<void(const InputEvent&)> on_event{}; ///< the same; may be empty
};

class Camera {
  public:
    explicit Camera(CameraParts parts) : parts_{std::move(parts)} {}

    /// Reads until asked to stop (heard within about 0.1 s) or a recording ends. Call it once, in its own thread.
    void run(const std::stop_token& stop);
    /// As that of any input: a packet is a frame that was taken; `kernel_dropped` are those that came to nobody,
    /// because the driver or this thread was too slow; damaged ones are refused as malformed. `measurements` and
    /// `ring_dropped` are for whoever makes measurements of the frames.
    InputStatus& status() { return status_; }
    const InputStatus& status() const { return status_; }

  private:
    bool open();
    FrameStatus read_until_lost(const std::stop_token& stop);
    void deliver();
    void copy_counters();
    void note(std::string_view text);
    void fail(InputEvent::Kind kind, std::string_view text);
    void tell(InputEvent::Kind kind, std::string_view text) const;

    CameraParts parts_;
    InputStatus status_;
    BackOff back_off_;
    Frame frame_;
    std::string told_; ///< the trouble that was told last
    bool was_open_ = false;
};

} // namespace locus::camera
