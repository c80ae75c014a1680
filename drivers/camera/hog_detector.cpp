// People by their outline (HOG), also those who stand still.
#include "drivers/camera/detector_rows.h"
#include "drivers/camera/hog_people.h"
#include "drivers/camera/mat.h"
#include "drivers/camera/people_settings.h"
#include "drivers/camera/suppress.h"

namespace locus::camera {
namespace {

struct HogPeopleSettings : PeopleSettings, HogSettings {};

constexpr auto hog_people_options = joined(people_options<HogPeopleSettings>, hog_options<HogPeopleSettings>);

class HogDetector : public Detector {
  public:
    HogDetector(const HogPeopleSettings& settings, const ExpectedHeight& height)
        : settings_{settings}, hog_{settings}, heights_{height}, sorting_{settings} {}

    std::vector<vision::Detection> detect(const Picture& picture) override {
        ++pictures_;
        grid_.refresh(heights_, {picture.width_px, picture.height_px});
        auto found = hog_.find(as_mat(picture), [&](std::size_t level, const auto& box) {
            return level % turns == pictures_ % turns || grid_.is_possible(box);
        });
        const auto most_iou = static_cast<float>(settings_.most_iou);
        for (const auto& person : suppress(found, most_iou)) heights_.learn(person.box);
        std::erase_if(found, [&](const auto& person) { return !grid_.is_possible(person.box); });
        return with_chances(sorting_.sort(picture, suppress_by_vote(found, most_iou)));
    }

  private:
    HogPeopleSettings settings_;
    Hog hog_;
    HeightMap heights_;
    HeightGrid grid_;
    Sorting sorting_;
    std::size_t pictures_ = 0;
};

} // namespace

DetectorRow hog_row() {
    return {"hog", "People's outlines (HOG with OpenCV's weights), also of those who stand still.",
            option_table<HogPeopleSettings>(hog_people_options, {}, check_people<HogPeopleSettings>),
            [](const void* settings, const ExpectedHeight& height, std::string&) -> std::unique_ptr<Detector> {
                return std::make_unique<HogDetector>(*static_cast<const HogPeopleSettings*>(settings), height);
            }};
}

} // namespace locus::camera
