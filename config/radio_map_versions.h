// A radio map that goes on changing is kept as one file, and one more of each day before: what was learnt wrong can be
// taken back by putting an older one in its place.
#pragma once

#include "fusion/estimators/radio_particles_settings.h"
#include "fusion/radio/radio_map.h"

#include <cstddef>
#include <string>

namespace locus::config {

inline constexpr std::size_t max_map_versions = 7; ///< of days before

/// What was taught before comes in place of the survey in `settings.radio_map`, which then is `surveyed_map`. Cannot
/// it be used, all stays as surveyed, and `settings.calibration_note` says why: a daemon starts all the same.
void load_taught_map(RadioParticlesSettings& settings);

/// write_radio_map(); what is there of another `date` stays as PATH.DATE. Throws as that.
void write_map_version(const std::string& path, const radio::RadioMap& map);

/// PATH becomes PATH.set-aside, where it is there at all.
void set_map_aside(const std::string& path);

} // namespace locus::config
