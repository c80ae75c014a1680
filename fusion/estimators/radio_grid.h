// What radio_particles knows of the floor: a map's Gaussian process, or the path loss from the anchors.
#pragma once

#include "fusion/estimators/radio_particles_settings.h"
#include "fusion/radio/grid_in_use.h"
#include "fusion/site.h"

#include <memory>

namespace locus {

/// A grid without beacons where there is neither a map nor an anchor. Throws std::invalid_argument when the map says
/// nothing.
/// That of the settings, where they have one, so that whoever has it may put another grid into it.
std::shared_ptr<const radio::GridInUse> make_radio_grid(const Site& site, const RadioParticlesSettings& settings);

/// Takes seconds with hundreds of points. Throws std::invalid_argument when the map says nothing.
radio::GridInUse::Shared map_grid(const radio::RadioMap& map, double lost_share);

} // namespace locus
