// The part of the image in which people are looked for: a polygon, written as "x,y x,y x,y" in shares of the image's
// width and height, so that it stays when the size changes.
#pragma once

#include "fusion/vision/detection.h"

#include <optional>
#include <string_view>
#include <vector>

namespace locus::camera {

class Region {
  public:
    /// Empty text: the whole image. Empty answer: it is no polygon of at least three corners in 0..1.
    static std::optional<Region> parse(std::string_view text);

    /// Whether the feet of the box are in it.
    bool has_feet_of(const vision::BoxPx& box, int image_width_px, int image_height_px) const;

  private:
    struct Corner {
        float x, y;
    };
    std::vector<Corner> corners_;
};

} // namespace locus::camera
