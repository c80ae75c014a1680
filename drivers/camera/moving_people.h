// What two detectors have in common: the foreground, the heights that are learnt of it, and the settings of both. For
// .cpp files of this room only.
#pragma once

#include "drivers/camera/cover.h"
#include "drivers/camera/foreground.h"
#include "drivers/camera/height_grid.h"
#include "drivers/camera/people_settings.h"
#include "drivers/camera/regions.h"

#include <utility>

namespace locus::camera {

struct MotionSettings : PeopleSettings, ForegroundSettings, CoverSettings {};

template <class Settings>
inline constexpr std::array moving_options{
    option<&ForegroundSettings::history_frames, Settings>("history_frames", "", 2, 1'000'000,
                                                          "Frames after which what has stopped becomes background."),
    option<&ForegroundSettings::threshold_sigma, Settings>("threshold_sigma", "", 1, 100,
                                                           "How far a pixel must be from its background to move."),
    option<&ForegroundSettings::remove_shadows, Settings>("remove_shadows", "Whether shadows are left out."),
    option<&ForegroundSettings::darkest_shadow, Settings>("darkest_shadow", "", 0, 1,
                                                          "Share of the light that a shadow leaves."),
    option<&CoverSettings::least_filled, Settings>(
        "least_filled", "", 0.05, 1, "Share of a person's box that must move where no nearer person hides it."),
    option<&CoverSettings::least_visible, Settings>("least_visible", "", 0.05, 1,
                                                    "Share of the whole box that must move, hidden or not."),
};

class MovingPeople {
  public:
    MovingPeople(const MotionSettings& settings, ExpectedHeight height)
        : settings_{settings}, foreground_{settings}, heights_{std::move(height)} {}

    /// Takes in a picture; call it for each.
    void look(const cv::Mat& picture) {
        mask_ = foreground_.take(picture);
        shares_ = BoxShares{mask_};
        lone_.clear();
        if (++pictures_ <= settling_pictures) return;
        lone_ = regions_as_people(mask_, static_cast<float>(settings_.least_height_px));
        std::erase_if(lone_, [&](const auto& region) { return !is_lone_person(region, mask_.size()); });
        for (const auto& person : lone_) heights_.learn(person.box);
        grid_.refresh(heights_, mask_.size());
    }

    /// People in what moves beside those that are `known`.
    std::vector<vision::Detection> find(const std::vector<vision::Detection>& known = {}) const {
        if (pictures_ <= settling_pictures) return {};
        return heights_.is_known() ? cover(mask_, grid_.standing(), settings_, known) : lone_;
    }
    const HeightGrid& heights() const { return grid_; }
    const cv::Mat& mask() const { return mask_; }
    const BoxShares& shares() const { return shares_; }

  private:
    static constexpr int settling_pictures = 10; // in which the background's model learns what is noise

    MotionSettings settings_;
    Foreground foreground_;
    HeightMap heights_;
    HeightGrid grid_;
    cv::Mat mask_;
    BoxShares shares_;                    ///< of the mask
    std::vector<vision::Detection> lone_; ///< regions that look like one person
    int pictures_ = 0;
};

} // namespace locus::camera
