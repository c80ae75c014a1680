#include "drivers/camera/odometry/visual_odometer.h"

#include "drivers/camera/mat.h"
#include "drivers/camera/odometry/key_frame_choice.h"
#include "drivers/camera/odometry/map_maker.h"
#include "drivers/camera/odometry/map_tracker.h"
#include "drivers/camera/odometry/motion_guess.h"
#include "drivers/camera/odometry/pose_search.h"

#include <opencv2/imgproc.hpp>

namespace locus::camera {

class VisualOdometer::Way {
  public:
    Way(const OdometerSettings& settings, const vision::Lens& lens, const Eigen::Vector2i& size_px,
        std::uint32_t first_segment)
        : settings_{settings}, finder_{lens, size_px, static_cast<int>(settings.features)},
          camera_{finder_.focal_px(), finder_.half_px()}, segment_{first_segment} {}

    OdometerReading look(const cv::Mat& grey, Timestamp captured) {
        const Features features = finder_.find(grey);
        std::optional<CameraPose> pose;
        if (map_.has_value())
            pose = follow(map_.value(), features, captured);
        else
            pose = begin(features, captured);
        return {state_, segment_, pose, pose.has_value() ? seen_ : 0};
    }

  private:
    std::optional<CameraPose> begin(const Features& features, Timestamp captured) {
        const auto matches = match_features(descriptors_of(reference_), descriptors_of(features));
        if (matches.size() < least_matches) {
            reference_ = features;
            return std::nullopt;
        }
        const auto view = find_two_view(reference_, features, matches, camera_.focal_px);
        if (!view.has_value()) return std::nullopt;
        VisualMap& map = map_.emplace(start_map(reference_, features, view.value(), camera_));
        state_ = OdometerState::tracking;
        const KeyFrame& newest = map.key(map.newest());
        last_ = newest.points;
        seen_ = count_points(last_);
        choice_.start(seen_);
        guess_.restart(newest.pose, captured);
        return newest.pose;
    }

    std::optional<CameraPose> follow(VisualMap& map, const Features& features, Timestamp captured) {
        auto tracked = track_map(map, features, camera_, guess_.at(captured), last_);
        if (!tracked.has_value()) {
            if (to_s(captured - guess_.last()) > settings_.lost_after_s) lose();
            return std::nullopt;
        }
        Tracked& seen = tracked.value();
        for (const PointId id : seen.expected) ++map.points().at(id).expected;
        for (const PointId id : seen.points)
            if (id != no_point) ++map.points().at(id).found;
        CameraPose pose = seen.pose;
        seen_ = seen.count;
        last_ = seen.points;
        if (choice_.wants(map, seen)) {
            const KeyId key = grow_map(map, {pose, features, std::move(seen.points)}, camera_, settings_.key_frames);
            pose = map.key(key).pose;
            last_ = map.key(key).points;
            choice_.start(seen_);
        }
        guess_.add(pose, captured);
        return pose;
    }

    void lose() {
        map_.reset();
        reference_.clear();
        ++segment_;
        state_ = OdometerState::lost;
    }

    static constexpr std::size_t least_matches = 100; // Mur-Artal 2015, section IV: else a new reference

    OdometerSettings settings_;
    FeatureFinder finder_;
    IdealCamera camera_;
    std::uint32_t segment_;
    OdometerState state_ = OdometerState::starting;
    Features reference_; ///< of the picture that a start is tried against
    std::optional<VisualMap> map_;
    std::vector<PointId> last_; ///< of the features of the last picture with a pose
    std::size_t seen_ = 0;
    MotionGuess guess_;
    KeyFrameChoice choice_;
};

VisualOdometer::VisualOdometer(const OdometerSettings& settings, const vision::Lens& lens,
                               const Eigen::Vector2i& size_px, std::uint32_t first_segment)
    : way_{std::make_unique<Way>(settings, lens, size_px, first_segment)} {
    cv::setNumThreads(1); // as for the detectors: a camera has one thread
}

VisualOdometer::~VisualOdometer() = default;

OdometerReading VisualOdometer::look(const Picture& picture, Timestamp captured) {
    const cv::Mat image = as_mat(picture);
    if (picture.channels == 1) return way_->look(image, captured);
    cv::Mat grey;
    cv::cvtColor(image, grey, cv::COLOR_BGR2GRAY);
    return way_->look(grey, captured);
}

} // namespace locus::camera
