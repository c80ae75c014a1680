// People by their outline (HOG), also those who stand still; and the same with what moves as a second witness.
#include "drivers/camera/chance.h"
#include "drivers/camera/detector_rows.h"
#include "drivers/camera/hog.h"
#include "drivers/camera/mat.h"
#include "drivers/camera/moving_people.h"
#include "drivers/camera/person_shape.h"
#include "drivers/camera/suppress.h"

#include <algorithm>

namespace locus::camera {
namespace {

struct HogPeopleSettings : PeopleSettings, HogSettings {};

template <class Settings>
inline constexpr std::array hog_options{
    option<&HogSettings::least_outline_px, Settings>(
        "least_outline_px", "px", 16, 500, "Height from which outlines are looked for: small ones cost most."),
    option<&HogSettings::least_margin, Settings>("least_margin", "", -2, 5,
                                                 "Margin of the support vector machine from which somebody is there."),
    option<&HogSettings::scale_step, Settings>("scale_step", "", 1.01, 2,
                                               "From one size that is looked for to the next; larger is faster."),
    option<&HogSettings::most_iou, Settings>("most_iou", "", 0, 1,
                                             "Overlap (intersection over union) of two people's boxes at most."),
};
constexpr auto hog_people_options = joined(people_options<HogPeopleSettings>, hog_options<HogPeopleSettings>);

/// Where no height is calibrated all sizes are possible.
bool is_possible(const vision::BoxPx& box, const HeightMap& heights) {
    if (!heights.is_known()) return true;
    const auto expected = heights.at(foot_x_px(box), box.bottom_px());
    return expected && has_expected_height(box.height_px, *expected);
}

/// In place of margins; what moves without an outline has the share of its box as its margin.
std::vector<vision::Detection> with_chances(std::vector<vision::Detection> people) {
    for (auto& person : people) person.score = chance_of_margin(person.score);
    return people;
}

class HogDetector : public Detector {
  public:
    HogDetector(const HogPeopleSettings& settings, const ExpectedHeight& height)
        : settings_{settings}, hog_{settings}, heights_{height}, sorting_{settings} {}

    std::vector<vision::Detection> detect(const Picture& picture) override {
        auto found = hog_.find(as_mat(picture));
        const auto most_iou = static_cast<float>(settings_.most_iou);
        for (const auto& person : suppress(found, most_iou)) heights_.learn(person.box);
        std::erase_if(found, [&](const auto& person) { return !is_possible(person.box, heights_); });
        return with_chances(sorting_.sort(picture, suppress(std::move(found), most_iou)));
    }

  private:
    HogPeopleSettings settings_;
    Hog hog_;
    HeightMap heights_;
    Sorting sorting_;
};

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

class HogMotionDetector : public Detector {
  public:
    HogMotionDetector(const HogMotionSettings& settings, const ExpectedHeight& height)
        : settings_{settings}, moving_{settings, height}, hog_{settings}, sorting_{settings} {}

    std::vector<vision::Detection> detect(const Picture& picture) override {
        const cv::Mat image = as_mat(picture);
        moving_.look(image);
        auto people = believed(hog_.find(image));
        const auto others = moving_.find(people);
        people.insert(people.end(), others.begin(), others.end());
        return with_chances(
            sorting_.sort(picture, suppress(std::move(people), static_cast<float>(settings_.most_iou))));
    }

  private:
    /// Outlines that are sure, or in which enough moves; what moves counts as margin.
    std::vector<vision::Detection> believed(std::vector<vision::Detection> outlines) const {
        std::vector<vision::Detection> people;
        for (auto& outline : outlines) {
            const float filled = filled_share(moving_.mask(), outline.box);
            const bool moves = filled >= moving_share;
            if (!is_possible(outline.box, moving_.heights()) || !(moves || outline.score >= settings_.sure_margin))
                continue;
            outline.score += filled;
            people.push_back(std::move(outline));
        }
        return suppress(std::move(people), static_cast<float>(settings_.most_iou));
    }

    static constexpr float moving_share = 0.25F; // half of what a walking person fills

    HogMotionSettings settings_;
    MovingPeople moving_;
    Hog hog_;
    Sorting sorting_;
};

} // namespace

DetectorRow hog_row() {
    return {"hog", "People's outlines (HOG with OpenCV's weights), also of those who stand still.",
            option_table<HogPeopleSettings>(hog_people_options, {}, check_people<HogPeopleSettings>),
            [](const void* settings, const ExpectedHeight& height, std::string&) -> std::unique_ptr<Detector> {
                return std::make_unique<HogDetector>(*static_cast<const HogPeopleSettings*>(settings), height);
            }};
}

DetectorRow hog_motion_row() {
    return {"hog_motion", "Outlines and motion together: finds more and errs less than either.",
            option_table<HogMotionSettings>(hog_motion_options, {}, check_people<HogMotionSettings>),
            [](const void* settings, const ExpectedHeight& height, std::string&) -> std::unique_ptr<Detector> {
                return std::make_unique<HogMotionDetector>(*static_cast<const HogMotionSettings*>(settings), height);
            }};
}

} // namespace locus::camera
