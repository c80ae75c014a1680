// A floor's strengths from a map, by Gaussian processes (Rasmussen and Williams 2006, ch. 2 and 5; Ferris, Haehnel and
// Fox 2006 for signal strength). Nothing is set by hand: how far places are alike, how much they share and how much
// not, where a beacon hangs and how fast it falls off are all weighed by how likely they make the map itself, and of a
// small map, which cannot tell, averaged by that weight.
#pragma once

#include "fusion/radio/radio_map.h"
#include "fusion/radio/strength_grid.h"

namespace locus::radio {

struct FieldSettings {
    double lost_share = 0.1;         ///< chance that a beacon in reach is not heard in a scan
    std::size_t most_corners = 8192; ///< of the cells that are worked out
};

/// Half a point spacing beyond the outermost points: what the map speaks of. Cells are half a spacing wide, or as wide
/// as they must be. Throws std::invalid_argument when the map has no point or nothing was heard.
FloorCells cells_of(const RadioMap& map, std::size_t most_corners);

/// Takes seconds with hundreds of points. Throws as cells_of().
StrengthGrid gaussian_field(const RadioMap& map, const FieldSettings& settings);

} // namespace locus::radio
