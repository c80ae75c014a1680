#include "drivers/camera/people_settings.h"

#include "drivers/camera/appearance.h"

#include <algorithm>

namespace locus::camera {

Sorting::Sorting(const PeopleSettings& settings)
    : settings_{settings}, region_{Region::parse(settings.region).value_or(Region{})} {}

std::vector<vision::Detection> Sorting::sort(const Picture& picture, std::vector<vision::Detection> found) const {
    std::erase_if(found, [&](const vision::Detection& detection) {
        const vision::BoxPx& box = detection.box;
        return !(box.height_px >= settings_.least_height_px && box.height_px <= settings_.most_height_px) ||
               !region_.has_feet_of(box, picture.width_px, picture.height_px);
    });
    std::stable_sort(found.begin(), found.end(),
                     [](const vision::Detection& a, const vision::Detection& b) { return a.score > b.score; });
    if (settings_.looks)
        for (auto& detection : found) {
            detection.appearance = appearance(picture, detection.box);
            detection.looks = looks(detection.appearance);
        }
    return found;
}

} // namespace locus::camera
