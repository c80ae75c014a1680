// From a shape into a frame: by anchors that are known, or by convention. Ranges alone cannot tell a shape from its
// mirror image, so every way in is tried for both.
#pragma once

#include "fusion/uwb/survey/network.h"

#include <array>
#include <cstddef>
#include <vector>

namespace locus::uwb::survey {

/// The mirror image: y the other way in two dimensions, z in three.
Positions mirrored(const Positions& shape_m, int dimensions);

/// The stations that make the frame: the origin, one on the x axis, and one beside it.
using FrameStations = std::array<std::size_t, 3>;

/// The first two, and the first of the others that lies clearly off the line through them, else the farthest off.
FrameStations frame_stations(const Positions& shape_m);

/// Turned and moved: the first of `frame` at the origin, the second on +x, the third in the plane z = 0 on the side of
/// +y (or -y). In two dimensions z is left alone and the third lies wherever the shape has it. No reflection.
Positions by_convention(const Positions& shape_m, const FrameStations& frame, int dimensions, bool third_on_right);

/// Turned and moved so that the stations `known` come nearest to where they are, without a reflection (Umeyama 1991).
/// In two dimensions z is left alone.
Positions by_known(const Positions& shape_m, const std::vector<std::size_t>& known, const Positions& known_m,
                   int dimensions);

/// Whether points, one a row, span this many dimensions of space by at least `least_m` each: 1 a line, 2 a plane.
bool spans(const Positions& points_m, int dimensions, double least_m);

} // namespace locus::uwb::survey
