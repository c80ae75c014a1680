// How good a detector is on annotated boxes: recall and precision at an intersection over union of 0.5 (Everingham et
// al. 2010, "The PASCAL visual object classes challenge", section 4.2: the surest detection first, each person once).
#pragma once

#include "fusion/vision/box_geometry.h"

#include <algorithm>
#include <vector>

namespace locus::test {

class DetectionScore {
  public:
    static constexpr float least_iou = 0.5F;

    void add(std::vector<vision::BoxPx> people, std::vector<vision::Detection> detections) {
        people_ += people.size();
        detections_ += detections.size();
        std::stable_sort(detections.begin(), detections.end(),
                         [](const auto& a, const auto& b) { return a.score > b.score; });
        for (const auto& detection : detections) {
            const auto best = std::max_element(people.begin(), people.end(), [&](const auto& a, const auto& b) {
                return vision::iou(a, detection.box) < vision::iou(b, detection.box);
            });
            if (best == people.end() || vision::iou(*best, detection.box) < least_iou) continue;
            ++found_;
            people.erase(best);
        }
    }
    double recall() const { return people_ ? static_cast<double>(found_) / static_cast<double>(people_) : 0; }
    double precision() const {
        return detections_ ? static_cast<double>(found_) / static_cast<double>(detections_) : 0;
    }

  private:
    std::size_t people_ = 0, detections_ = 0, found_ = 0;
};

} // namespace locus::test
