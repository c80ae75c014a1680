// Of several boxes around one person the surest stays.
#pragma once

#include "fusion/vision/detection.h"

#include <vector>

namespace locus::camera {

/// Greedy non-maximum suppression: the surest first, none that overlaps a surer one by more than `most_iou`.
std::vector<vision::Detection> suppress(std::vector<vision::Detection> detections, float most_iou);

} // namespace locus::camera
