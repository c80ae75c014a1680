// Of several boxes around one person the surest stays.
#pragma once

#include "fusion/vision/detection.h"

#include <vector>

namespace locus::camera {

/// Greedy non-maximum suppression: the surest first, none that overlaps a surer one by more than `most_iou`.
std::vector<vision::Detection> suppress(std::vector<vision::Detection> detections, float most_iou);

/// The same; each box that stays becomes the mean of all that lie closely on it, weighted with their scores where those
/// are positive ("box voting": Gidaris and Komodakis 2015, section 5), so the grid that boxes were looked for on shows
/// less.
std::vector<vision::Detection> suppress_by_vote(const std::vector<vision::Detection>& detections, float most_iou);

} // namespace locus::camera
