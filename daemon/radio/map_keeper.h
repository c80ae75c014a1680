// The radio map as those teach it whom cameras see: a thread of its own takes their lessons, and every so often writes
// the map down, works out the grid that estimators read, and hands it to the fusion thread.
#pragma once

#include "daemon/fusion_loop.h"
#include "fusion/estimators/radio_particles_settings.h"
#include "fusion/radio/calibrated_map.h"

#include <memory>
#include <thread>

namespace locus {

class MapKeeper {
  public:
    /// Null where no settings name a calibrated map. `lessons` and `fusion` outlive it.
    static std::unique_ptr<MapKeeper> make(const EngineSettings& settings, LessonRing& lessons, FusionLoop& fusion);

    /// `settings` name a calibrated map, and what it is made of was read.
    MapKeeper(std::shared_ptr<const RadioParticlesSettings> settings, LessonRing& lessons, FusionLoop& fusion);
    /// Writes down what was taught since the last time.
    ~MapKeeper();
    MapKeeper(const MapKeeper&) = delete;
    MapKeeper& operator=(const MapKeeper&) = delete;

    /// In a thread of its own until destroyed. Once.
    void start();

    /// What the thread does all the time; tests call it alone. `date` is that of the day, YYYY-MM-DD.
    void work(Timestamp now, const std::string& date);

  private:
    void take_lessons();
    void renew(const std::string& date);
    void write(const std::string& date);
    void hand_over();

    std::shared_ptr<const RadioParticlesSettings> settings_;
    LessonRing& lessons_;
    FusionLoop& fusion_;
    radio::CalibratedMap map_;
    std::uint64_t taken_ = 0, withdrawn_ = 0; ///< since the map was renewed
    Timestamp renewed_{};
    bool may_hand_over_ = true; ///< the one before has come back
    std::jthread thread_;
};

} // namespace locus
