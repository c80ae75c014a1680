// A picture without any picture library, so that whoever passes one on need not compile OpenCV.
#pragma once

#include "fusion/time.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace locus::camera {

/// No camera of this decade is wider or higher, and no picture that claims to be is given memory.
inline constexpr int max_side_px = 8192;

struct Picture {
    int width_px = 0;
    int height_px = 0;
    int channels = 3;                 ///< 3: blue, green, red; 1: grey
    std::vector<std::uint8_t> pixels; ///< rows from the top, without gaps

    bool empty() const { return pixels.empty(); }

    /// The pixels' contents are anything afterwards; memory of an equal size is kept.
    void resize(int new_width_px, int new_height_px, int new_channels) {
        width_px = new_width_px;
        height_px = new_height_px;
        channels = new_channels;
        pixels.resize(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) *
                      static_cast<std::size_t>(channels));
    }
};

struct Frame {
    Picture picture;
    Timestamp captured;         ///< middle of the exposure, as well as the source knows it
    std::uint64_t sequence = 0; ///< rises by one for every frame of the camera, also those that were lost
};

} // namespace locus::camera
