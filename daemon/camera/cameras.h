// One camera at work: a thread that takes frames, finds the people in them and puts their foot points into a ring, as
// an input does with its measurements; or its own way, where it is worn. Either takes a core for a while, so it never
// runs at the priority of inputs.
#pragma once

#include "daemon/camera/onlooker.h"
#include "daemon/camera/viewfinder.h"
#include "daemon/camera/worn_camera.h"
#include "daemon/event_log.h"
#include "daemon/realtime.h"
#include "daemon/running_set.h"
#include "daemon/socket/roster.h"
#include "drivers/camera/camera.h"

#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace locus {

/// Destroyed, it has stopped.
class RunningCamera {
  public:
    /// `place` in the settings is its address. `recording` gets every measurement; null: none is kept.
    RunningCamera(const CameraInputSettings& settings, std::size_t place, LogFile* recording);

    void request_stop() { thread_.request_stop(); }
    void schedule(int /*priority*/) { schedule_thread(thread_.native_handle(), 0); }
    /// Both may outlive this.
    std::shared_ptr<MeasurementRing> ring() const { return {body_, &body_->ring}; }
    std::shared_ptr<const InputStatus> status() const { return {body_, &body_->device.status()}; }
    std::shared_ptr<Viewfinder> view() const { return {body_, &body_->view}; }

    /// Foot points hold their camera's address.
    static bool may_move_to(std::size_t place, std::size_t before) { return place == before; }

  private:
    struct Body {
        Body(const CameraInputSettings& given, std::size_t place, LogFile* to);
        camera::CameraParts parts();
        void see(const camera::Frame& frame);
        void find_people(const camera::Frame& frame);
        void find_way(const camera::Frame& frame);
        void give(const Observation& observation, Timestamp time);
        void tell_trouble(const std::string& trouble);
        void show(const camera::Frame& frame, std::span<const vision::ImageTrack> tracks);

        std::string name;
        camera::FrameSourceRow source;
        std::shared_ptr<void> source_settings;
        Address address;
        LogFile* recording;
        EventLog log;
        Onlooker onlooker;
        std::optional<WornCamera> worn; ///< then nobody looks on
        Viewfinder view;
        std::string told; ///< trouble that was told last
        std::uint32_t sequence = 0;
        MeasurementRing ring;
        camera::Camera device;
    };
    std::shared_ptr<Body> body_;
    std::jthread thread_;
};

using CameraSet = RunningSet<CameraInputSettings, RunningCamera>;

std::vector<InputEntry> entries(const CameraSet& cameras);

} // namespace locus
