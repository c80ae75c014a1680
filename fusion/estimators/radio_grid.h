// What radio_particles knows of the floor: a map's Gaussian process, or the path loss from the anchors.
#pragma once

#include "fusion/estimators/radio_particles_settings.h"
#include "fusion/radio/strength_grid.h"
#include "fusion/site.h"

#include <memory>

namespace locus {

/// A grid without beacons where there is neither a map nor an anchor. Throws std::invalid_argument when the map says
/// nothing.
std::shared_ptr<const radio::StrengthGrid> make_radio_grid(const Site& site, const RadioParticlesSettings& settings);

} // namespace locus
