#include "drivers/camera/camera.h"

#include <deque>

#include <gtest/gtest.h>

namespace locus::camera {
namespace {

/// What the source shall do next, call by call; then it has ended.
struct Script {
    std::deque<bool> opens;
    std::deque<FrameStatus> reads;
};

class ScriptedSource : public FrameSource {
  public:
    explicit ScriptedSource(Script& script) : script_{script} {}
    bool open() override {
        if (script_.opens.empty()) return true;
        const bool works = script_.opens.front();
        script_.opens.pop_front();
        return works;
    }
    void close() override {}
    FrameStatus next(Frame& frame, Duration) override {
        if (script_.reads.empty()) return FrameStatus::ended;
        const FrameStatus status = script_.reads.front();
        script_.reads.pop_front();
        frame.captured = timestamp_from_ns(++frames_);
        return status;
    }
    std::uint64_t dropped() const override { return 3; }
    std::string_view last_error() const override { return "it was pulled"; }

  private:
    Script& script_;
    int frames_ = 0;
};

TEST(CameraThread, OpensAgainAfterEveryLoss) {
    Script script{.opens = {false, false, true, true},
                  .reads = {FrameStatus::frame, FrameStatus::lost, FrameStatus::nothing, FrameStatus::frame}};
    std::vector<std::int64_t> stamps_ns;
    std::vector<InputEvent::Kind> events;
    Camera camera{{.source = std::make_unique<ScriptedSource>(script),
                   .on_frame = [&](const Frame& frame) { stamps_ns.push_back(to_ns(frame.captured)); },
                   .on_event = [&](const InputEvent& event) { events.push_back(event.kind); }}};
    camera.run({});
    using enum InputEvent::Kind;
    EXPECT_EQ(events, (std::vector{unavailable, opened, lost, opened, ended})) << "the second failure is no news";
    EXPECT_EQ(stamps_ns, (std::vector<std::int64_t>{1, 4}));
    EXPECT_EQ(camera.status().frames, 2);
    EXPECT_EQ(camera.status().reconnects, 1);
    EXPECT_EQ(camera.status().kernel_dropped, 3);
    EXPECT_EQ(camera.status().last_packet_ns, 4);
    EXPECT_EQ(camera.status().state, InputState::ended);
}

TEST(CameraThread, StopsWhenAsked) {
    Script script{.opens = {}, .reads = std::deque<FrameStatus>(1000, FrameStatus::frame)};
    std::stop_source stop;
    Camera camera{{.source = std::make_unique<ScriptedSource>(script), .on_frame = [&](const Frame& frame) {
                       if (to_ns(frame.captured) == 5) stop.request_stop();
                   }}};
    camera.run(stop.get_token());
    EXPECT_EQ(camera.status().frames, 5);
    EXPECT_EQ(camera.status().state, InputState::stopped);
}

} // namespace
} // namespace locus::camera
