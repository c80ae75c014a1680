// The service: owns the threads and what lies between them, and does in the main thread all that is slow: reading the
// configuration, making engines, opening and closing inputs, talking to the service manager.
#pragma once

#include "config/load.h"
#include "daemon/camera/cameras.h"
#include "daemon/fusion_loop.h"
#include "daemon/inputs.h"
#include "daemon/manager.h"
#include "daemon/radio/map_keeper.h"
#include "daemon/signals.h"
#include "daemon/socket/listener.h"
#include "daemon/socket/publisher.h"
#include "daemon/vital_signs.h"

#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace locus {

class Service {
  public:
    /// Makes the engine and starts every thread. Throws std::invalid_argument with a sentence when the settings cannot
    /// work. `config`: path that a reload reads again. `recording` gets what comes in and outlives this; null: none.
    Service(Settings settings, std::string config, Listener listener, LogFile* recording = nullptr);

    /// Stops every thread; takes about 0.1 s.
    ~Service();

    /// Looks after everything until `stop` is raised or SIGTERM or SIGINT comes.
    void run(const Signals& signals);

    /// Any thread: run() comes back.
    void stop();

    /// Reads the configuration again. Any problem: all stays as it was, and the problems come back as sentences.
    std::vector<std::string> reload();

  private:
    std::unique_ptr<FusionPlan> plan(std::unique_ptr<Engine> engine) const;
    std::unique_ptr<const Roster> roster() const;
    std::unique_ptr<Engine> engine_if_changed(const Settings& settings) const;
    void put_in_force(Settings settings, std::unique_ptr<Engine> engine);
    void keep_map();
    void lock();

    void wait(const Signals& signals) const;
    void heed(const Signals& signals);
    void serve_reload_requests();
    void reload_and_log();
    void collect_retired();
    void report();
    void flush_recording();
    std::string summary() const;

    Settings settings_;
    std::string config_;
    Timestamp started_;
    Generation generation_ = 1;
    bool memory_locked_ = false;
    std::atomic<bool> stop_{false};
    bool ready_ = false;
    bool scheduling_told_ = false;
    bool plan_on_its_way_ = false;
    bool hang_up_ = false; ///< SIGHUP came
    Manager manager_;
    VitalSigns vital_signs_;

    LogFile* recording_; ///< null: none, or it could not be written any more

    FusionOutput output_;
    Wake ticked_;
    Post post_;
    InputSet inputs_;
    CameraSet cameras_;
    FusionLoop fusion_;
    Publisher publisher_;
    std::unique_ptr<MapKeeper> map_keeper_; ///< null: no map is to change
    std::jthread fusion_thread_;
    std::jthread publisher_thread_;
};

} // namespace locus
