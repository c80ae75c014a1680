#include "drivers/camera/suppress.h"

#include "fusion/vision/box_geometry.h"

#include <algorithm>
#include <utility>

namespace locus::camera {

std::vector<vision::Detection> suppress(std::vector<vision::Detection> detections, float most_iou) {
    std::stable_sort(detections.begin(), detections.end(),
                     [](const vision::Detection& a, const vision::Detection& b) { return a.score > b.score; });
    std::vector<vision::Detection> kept;
    for (auto& detection : detections) {
        const bool is_new = std::none_of(kept.begin(), kept.end(), [&](const vision::Detection& other) {
            return vision::iou(other.box, detection.box) > most_iou;
        });
        if (is_new) kept.push_back(std::move(detection));
    }
    return kept;
}

} // namespace locus::camera
