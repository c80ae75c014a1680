// One person that the tracker follows: where his box is, how he looked, and how long ago he was seen.
#pragma once

#include "fusion/vision/box_filter.h"
#include "fusion/vision/detection.h"
#include "fusion/vision/gallery.h"
#include "fusion/vision/tracker_settings.h"

#include <cstdint>

namespace locus::vision {

struct Track {
    Track(std::uint32_t number, const Detection& first, const TrackerSettings& settings)
        : id(number), filter(first.box, settings), gallery(settings.gallery), looks(first.looks), seen_box(first.box),
          score(first.score) {
        gallery.add(first.appearance);
    }

    std::uint32_t id;
    BoxFilter filter;
    Gallery gallery;
    Looks looks;            ///< when he was last seen without anybody before him
    BoxPx seen_box;         ///< the filter's when he was last seen
    float score;            ///< of the last detection
    std::uint32_t hits = 1; ///< detections until he was confirmed
    bool is_confirmed = false;
    bool is_covered = false; ///< by somebody nearer, as far as was foreseen for the last image
    bool feet_seen = true;   ///< in the last detection
    double age_s = 0;
    double unseen_s = 0;

    void predict(double dt_s) noexcept {
        filter.predict(dt_s);
        age_s += dt_s;
        unseen_s += dt_s;
    }
};

} // namespace locus::vision
