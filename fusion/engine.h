// Engine: measurements in, poses out. Clocks, timeline, then identity, then estimators. No clock, no I/O, no thread;
// after construction no allocation. `locus replay` and the daemon run this very code.
#pragma once

#include "fusion/aid_status.h"
#include "fusion/estimators/estimator.h"
#include "fusion/gnss/settings.h"
#include "fusion/option.h"
#include "fusion/pose.h"
#include "fusion/radio/lesson.h"
#include "fusion/site.h"
#include "fusion/uwb/anchor_health_settings.h"
#include "fusion/uwb/clock_sync/settings.h"
#include "fusion/vision/settings.h"

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace locus {

struct FusionSettings {
    double rate_hz = 100;
    double window_s = 0.2;
    double lost_after_s = 2;
    int max_targets = 64;
    double max_measurement_rate_hz = 1000;
    bool accept_unknown_targets = true;
    double smooth_lag_s = 0;
    std::string estimator = "inertial_ekf";
};

inline constexpr std::array fusion_options{
    option<&FusionSettings::rate_hz>("rate_hz", "Hz", 1, 1000, "Ticks, and poses of each target, per second."),
    option<&FusionSettings::window_s>("window_s", "s", 0.01, 5,
                                      "How late a measurement may come and still count as if it had come in order."),
    option<&FusionSettings::lost_after_s>("lost_after_s", "s", 0.05, 3600,
                                          "A target unheard for this long has no pose until it is heard again."),
    option<&FusionSettings::smooth_lag_s>(
        "smooth_lag_s", "s", 0, 5,
        "For those who can wait: poses of so long ago that know what came since, beside the others; 0: none."),
    option<&FusionSettings::max_targets>("max_targets", "", 1, 4096, "Targets that memory is set aside for."),
    option<&FusionSettings::max_measurement_rate_hz>(
        "max_measurement_rate_hz", "Hz", 10, 10000,
        "Measurements of one target per second that the window has room for (about 200 bytes each)."),
    option<&FusionSettings::accept_unknown_targets>(
        "accept_unknown_targets", "Whether a tag that is not listed under targets is followed as well."),
    option<&FusionSettings::estimator>("estimator", "Estimator of targets that name none."),
};

struct TargetSettings {
    std::string name;
    Address address = no_address;
    std::string estimator; ///< empty: FusionSettings::estimator
};

inline constexpr std::array target_options{
    required_option<&TargetSettings::name>("name", "Name that people see."),
    required_option<&TargetSettings::address>("address", "The number its tag calls itself by: 3, 0x1234, DE:CA:..."),
    option<&TargetSettings::estimator>("estimator", "Estimator for this target; left out: fusion.estimator."),
};

/// Settings of one estimator as its option table made them.
struct EstimatorSettings {
    const EstimatorRow* row = nullptr;
    std::shared_ptr<const void> settings;
};

struct EngineSettings {
    FusionSettings fusion;
    ClockSyncSettings clock_sync;
    uwb::AnchorHealthSettings anchor_health;
    GnssSettings gnss;
    VisionSettings vision;
    std::size_t cameras = 0; ///< their addresses are 0, 1, ...
    Site site;
    std::vector<TargetSettings> targets;
    std::vector<EstimatorSettings> estimators; ///< only those whose settings differ from the defaults need be here
};

class Engine {
  public:
    /// Throws std::invalid_argument with a sentence when the settings cannot work (an estimator of unknown name).
    explicit Engine(EngineSettings settings);
    ~Engine();

    /// Takes a measurement that arrived at `arrival`; order of calls need not be order of sample times.
    void submit(const Measurement& measurement, Timestamp arrival) noexcept;

    /// Runs every target up to `tick` and returns a pose for each known target, valid until the next call. Targets
    /// without a position are there too; estimate.missing says why. Tick times strictly increase: a tick
    /// that does not lie after the last one gives nothing.
    std::span<const Pose> step(Timestamp tick) noexcept;

    /// Of the last step(), with smooth_lag_s set: where each target was that long before, by what came since as well.
    /// Targets that have not been followed that long without a jump are left out.
    std::span<const Pose> smoothed() const noexcept;

    /// What those taught of the radio map, since the last call, whom cameras saw. Valid until the next submit() or
    /// step(); whoever keeps no map need not call it.
    std::span<const radio::Lesson> take_lessons() noexcept;

    std::span<const AidStatus> sources() const noexcept;
    const EngineCounters& counters() const noexcept;
    const EngineSettings& settings() const noexcept;

    /// Configured name, else the address in hexadecimal. The view lives as long as the engine.
    std::string_view target_name(std::uint16_t target_index) const noexcept;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace locus
