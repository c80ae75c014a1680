// Expected heights for a hundred thousand windows a picture: a calibration is asked once for each few pixels, and not
// again for each window. For .cpp files of this room only.
#pragma once

#include "drivers/camera/height_map.h"

#include <opencv2/core.hpp>

#include <vector>

namespace locus::camera {

class HeightGrid {
  public:
    /// Takes over what the map says of a picture of that size, where it is not known yet.
    void refresh(const HeightMap& heights, const cv::Size& picture);

    /// Whether somebody can be so high there. Where no height is known all are possible.
    bool is_possible(const vision::BoxPx& box) const;

    /// The boxes of people who stand wherever somebody can, some pixels apart; empty where no height is known.
    const std::vector<vision::BoxPx>& standing() const { return standing_; }

  private:
    std::vector<vision::BoxPx> standing_;
    cv::Mat1f cells_; ///< 0: nobody can stand there; empty: nothing is known
    cv::Size picture_;
    std::size_t revision_ = 0;
};

} // namespace locus::camera
