#include "drivers/camera/suppress.h"

#include "fusion/vision/box_geometry.h"

#include <algorithm>
#include <utility>

namespace locus::camera {
namespace {

constexpr float same_person_iou = 0.7F;

vision::BoxPx mean_box(const vision::Detection& kept, const std::vector<vision::Detection>& all) {
    vision::BoxPx sum{0, 0, 0, 0};
    float weights = 0;
    for (const vision::Detection& one : all) {
        const vision::BoxPx& box = one.box;
        const float score = one.score;
        if (!(score > 0) || vision::iou(box, kept.box) < same_person_iou) continue;
        weights += score;
        sum.left_px += score * box.left_px;
        sum.top_px += score * box.top_px;
        sum.width_px += score * box.width_px;
        sum.height_px += score * box.height_px;
    }
    if (!(weights > 0)) return kept.box;
    return {sum.left_px / weights, sum.top_px / weights, sum.width_px / weights, sum.height_px / weights};
}

} // namespace

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

std::vector<vision::Detection> suppress_by_vote(const std::vector<vision::Detection>& detections, float most_iou) {
    auto kept = suppress(detections, most_iou);
    for (auto& detection : kept) detection.box = mean_box(detection, detections);
    return kept;
}

} // namespace locus::camera
