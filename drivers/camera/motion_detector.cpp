// People are what moves before a fixed camera. Needs no weights and runs on any box; who stands still for long is lost.
#include "drivers/camera/chance.h"
#include "drivers/camera/detector_rows.h"
#include "drivers/camera/mat.h"
#include "drivers/camera/moving_people.h"

namespace locus::camera {
namespace {

constexpr auto motion_options = joined(people_options<MotionSettings>, moving_options<MotionSettings>);

class MotionDetector : public Detector {
  public:
    MotionDetector(const MotionSettings& settings, const ExpectedHeight& height)
        : moving_{settings, height}, sorting_{settings} {}

    std::vector<vision::Detection> detect(const Picture& picture) override {
        moving_.look(as_mat(picture));
        auto people = sorting_.sort(picture, moving_.find());
        for (auto& person : people) person.score = chance_of_movement;
        return people;
    }

  private:
    MovingPeople moving_;
    Sorting sorting_;
};

} // namespace

DetectorRow motion_row() {
    return {"motion", "What moves before a fixed camera (MOG2), parted into people of the expected height.",
            option_table<MotionSettings>(motion_options, {}, check_people<MotionSettings>),
            [](const void* settings, const ExpectedHeight& height, std::string&) -> std::unique_ptr<Detector> {
                return std::make_unique<MotionDetector>(*static_cast<const MotionSettings*>(settings), height);
            }};
}

} // namespace locus::camera
