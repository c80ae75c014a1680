// Frames of an unknown binary stream: where they begin, how long they are, and what guards them, as the settings of a
// serial_layout that finds them again.
#pragma once

#include "drivers/layout/serial_layout.h"
#include "drivers/wire/bytes.h"

#include <optional>
#include <vector>

namespace locus::sniff {

struct FrameGuess {
    layout::SerialLayoutSettings layout; ///< with one field that says nothing, because a layout must have one
    std::size_t frames = 0;              ///< that it finds
    double share = 0;                    ///< of the bytes that they are
    std::size_t shortest = 0, longest = 0;
    std::vector<std::vector<std::uint8_t>> samples; ///< some of the frames
};

/// Empty when nothing convinces: in noise, in text that is no frames, in too few bytes. Looks at the first 32 kB.
std::optional<FrameGuess> guess_frames(wire::Bytes bytes);

/// The frames that a layout finds, in numbers and samples.
FrameGuess measured(const layout::SerialLayoutSettings& layout, wire::Bytes bytes);

} // namespace locus::sniff
