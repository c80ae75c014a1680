// People by their outline and by what moves, each the other's witness.
#include "drivers/camera/detector_rows.h"
#include "drivers/camera/hog_people.h"
#include "drivers/camera/mat.h"
#include "drivers/camera/moving_people.h"
#include "drivers/camera/suppress.h"

#include <opencv2/imgproc.hpp>

namespace locus::camera {
namespace {

/// What moves and has no outline of a person must be a better silhouette than what one looks at alone: as much of the
/// box as a walking person fills, less a tenth.
struct HogMotionSettings : MotionSettings, HogSettings {
    HogMotionSettings() {
        least_filled = 0.45;
        least_visible = 0.4;
        least_margin = 0;
    }
    double sure_margin = 0.6;
};

constexpr auto hog_motion_options =
    joined(joined(joined(people_options<HogMotionSettings>, hog_options<HogMotionSettings>),
                  moving_options<HogMotionSettings>),
           std::array{option<&HogMotionSettings::sure_margin>(
               "sure_margin", "", -2, 5, "Margin from which an outline is a person even if nothing moves.")});

/// Outlines are looked for where something moves, where somebody was a picture ago, and everywhere in one size of
/// `turns` a picture: whoever stands still is found within that many pictures, and then stays.
constexpr float moving_share = 0.25F;     // half of what a walking person fills
constexpr float same_place_share = 0.67F; // of a box: half of what two of one size have together

class HogMotionDetector : public Detector {
  public:
    HogMotionDetector(const HogMotionSettings& settings, const ExpectedHeight& height)
        : settings_{settings}, moving_{settings, height}, hog_{settings}, sorting_{settings} {}

    std::vector<vision::Detection> detect(const Picture& picture) override {
        const cv::Mat image = as_mat(picture);
        moving_.look(image);
        ++pictures_;
        auto people = believed(hog_.find(image, [&](std::size_t level, const auto& box) {
            return (level % turns == pictures_ % turns || moves(box) || was_there(box)) &&
                   moving_.heights().is_possible(box);
        }));
        remember(people, image.size());
        const auto others = moving_.find(people);
        people.insert(people.end(), others.begin(), others.end());
        return with_chances(
            sorting_.sort(picture, suppress(std::move(people), static_cast<float>(settings_.most_iou))));
    }

  private:
    bool moves(const vision::BoxPx& box) const { return moving_.shares().of(box) >= moving_share; }

    bool was_there(const vision::BoxPx& box) const { return outlined_.of(box) >= same_place_share; }

    void remember(const std::vector<vision::Detection>& outlines, const cv::Size& picture) {
        cv::Mat1b mask(picture, 0);
        for (const auto& outline : outlines)
            cv::rectangle(
                mask, cv::Rect2f(outline.box.left_px, outline.box.top_px, outline.box.width_px, outline.box.height_px),
                255, cv::FILLED);
        outlined_ = BoxShares{mask};
    }

    /// The lower end is the mean of what both witnesses say: outlines come in steps of a twelfth of a person, and
    /// shadows and floor of the shoes' colour take the silhouette's feet.
    vision::BoxPx with_feet_of_both(const vision::BoxPx& outline) const {
        const auto lowest_px = lowest_moving_px(moving_.mask(), outline);
        if (!lowest_px.has_value()) return outline;
        vision::BoxPx box = outline;
        box.height_px += (lowest_px.value() - outline.bottom_px()) / 2;
        return box;
    }

    /// Outlines that are sure, or in which enough moves; what moves counts as margin.
    std::vector<vision::Detection> believed(std::vector<vision::Detection> outlines) const {
        std::vector<vision::Detection> people;
        for (auto& outline : outlines) {
            if (!moving_.heights().is_possible(outline.box)) continue;
            if (!moves(outline.box) && outline.score < settings_.sure_margin) continue;
            outline.score += moving_.shares().of(outline.box);
            people.push_back(std::move(outline));
        }
        people = suppress_by_vote(people, static_cast<float>(settings_.most_iou));
        for (auto& person : people) person.box = with_feet_of_both(person.box);
        return people;
    }

    HogMotionSettings settings_;
    MovingPeople moving_;
    Hog hog_;
    Sorting sorting_;
    BoxShares outlined_; ///< boxes of those who had an outline a picture ago
    std::size_t pictures_ = 0;
};

} // namespace

DetectorRow hog_motion_row() {
    return {"hog_motion", "Outlines and motion together: finds more and errs less than either.",
            option_table<HogMotionSettings>(hog_motion_options, {}, check_people<HogMotionSettings>),
            [](const void* settings, const ExpectedHeight& height, std::string&) -> std::unique_ptr<Detector> {
                return std::make_unique<HogMotionDetector>(*static_cast<const HogMotionSettings*>(settings), height);
            }};
}

} // namespace locus::camera
