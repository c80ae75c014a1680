#include "daemon/radio/map_keeper.h"

#include "config/radio_map.h"
#include "config/radio_map_versions.h"
#include "daemon/realtime.h"
#include "drivers/clock.h"
#include "drivers/stoppable_sleep.h"
#include "fusion/estimators/radio_grid.h"
#include "fusion/estimators/radio_particles.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>

namespace locus {
namespace {

constexpr Duration between_looks = std::chrono::milliseconds{200}; // the ring holds some seconds of lessons

} // namespace

std::unique_ptr<MapKeeper> MapKeeper::make(const EngineSettings& settings, LessonRing& lessons, FusionLoop& fusion) {
    const auto row = std::ranges::find_if(
        settings.estimators, [](const EstimatorSettings& each) { return each.row->name == radio_particles_row.name; });
    if (row == settings.estimators.end()) return nullptr;
    auto radio = std::static_pointer_cast<const RadioParticlesSettings>(row->settings);
    if (radio->surveyed_map == nullptr) return nullptr;
    return std::make_unique<MapKeeper>(std::move(radio), lessons, fusion);
}

MapKeeper::MapKeeper(std::shared_ptr<const RadioParticlesSettings> settings, LessonRing& lessons, FusionLoop& fusion)
    : settings_{std::move(settings)}, lessons_{lessons}, fusion_{fusion},
      map_{*settings_->surveyed_map, *settings_->radio_map, {}} {
    if (settings_->calibration_note.empty()) return;
    spdlog::warn("{}; the radio map is as it was surveyed, and that file is set aside", settings_->calibration_note);
    config::set_map_aside(settings_->calibrated_map);
}

MapKeeper::~MapKeeper() {
    thread_ = {}; // stops and waits for it
    take_lessons();
    if (taken_ + withdrawn_ > 0) write(config::date_of_today());
}

void MapKeeper::start() {
    thread_ = std::jthread{[this](const std::stop_token& stop) {
        name_this_thread("radio map");
        renewed_ = monotonic_now();
        while (!stop.stop_requested()) {
            sleep_unless_stopped(stop, between_looks);
            work(monotonic_now(), config::date_of_today());
        }
    }};
}

void MapKeeper::work(Timestamp now, const std::string& date) {
    take_lessons();
    while (fusion_.retired_grids.take()) may_hand_over_ = true;
    if (to_s(now - renewed_) < settings_->calibrate_every_s || !may_hand_over_) return;
    renewed_ = now;
    if (taken_ + withdrawn_ > 0) renew(date);
}

void MapKeeper::take_lessons() {
    for (radio::Lesson lesson; lessons_.pop(lesson);) {
        ++(lesson.is_withdrawn ? withdrawn_ : taken_);
        map_.heed(lesson);
    }
}

void MapKeeper::renew(const std::string& date) {
    write(date);
    hand_over();
    taken_ = withdrawn_ = 0;
}

/// A disk that is full must not keep the map from coming into use.
void MapKeeper::write(const std::string& date) {
    radio::RadioMap map = map_.map();
    map.date = date;
    try {
        config::write_map_version(settings_->calibrated_map, map);
        spdlog::info("radio map {}: {} readings taught it, {} names were withdrawn; strengths are {:.1f} dB from the "
                     "survey in the mean",
                     settings_->calibrated_map, taken_, withdrawn_, map_.moved_db());
    } catch (const std::exception& error) {
        spdlog::error("the calibrated radio map is in use, but {}", error.what());
    }
}

void MapKeeper::hand_over() {
    auto next = std::make_unique<NewGrid>(NewGrid{settings_->grid, map_grid(map_.map(), settings_->lost_share)});
    may_hand_over_ = !fusion_.grids.give(next);
}

} // namespace locus
