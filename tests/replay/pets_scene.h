// PETS 2009 S2.L1 as a scene: where the annotated people stand on the floor, four anchors 3 m up, a metre outside the
// corners of where they walk, what stands in the radio's way (places read off the first image: the lamp post with its
// sign, and the blue sign on the right), and what a tracker makes of detections.
#pragma once

#include "config/camera_calibration.h"
#include "fusion/vision/tracker.h"
#include "tests/papers/walk.h"
#include "tests/replay/pets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace locus::test {

inline constexpr double pets_start_s = 1;
inline double pets_time_s(std::size_t frame) { return pets_start_s + pets_frame_s * static_cast<double>(frame); }

/// One person's way on the floor, a place for each frame in which he is annotated.
class PetsWay {
  public:
    void add(std::size_t frame, const Eigen::Vector2d& place_m) { places_m_.emplace(pets_time_s(frame), place_m); }
    double first_s() const { return places_m_.begin()->first; }
    double last_s() const { return places_m_.rbegin()->first; }
    std::optional<Eigen::Vector2d> at(double time_s) const {
        const auto after = places_m_.lower_bound(time_s);
        if (after == places_m_.end() || time_s < first_s()) return {};
        if (after == places_m_.begin()) return after->second;
        const auto before = std::prev(after);
        if (after->first - before->first > 1.5 * pets_frame_s) return {}; // he was outside meanwhile
        const double share = (time_s - before->first) / (after->first - before->first);
        return before->second + share * (after->second - before->second);
    }
    /// Which way he walks; zero when he stands.
    Eigen::Vector2d heading(double time_s) const {
        const auto before = at(time_s - 0.5), after = at(time_s + 0.5);
        if (!before.has_value() || !after.has_value()) return Eigen::Vector2d::Zero();
        const Eigen::Vector2d way_m = after.value() - before.value();
        return way_m.norm() > 0.2 ? way_m.normalized() : Eigen::Vector2d::Zero();
    }
    const std::map<double, Eigen::Vector2d>& places_m() const { return places_m_; }

  private:
    std::map<double, Eigen::Vector2d> places_m_;
};

struct PetsScene {
    std::vector<BoxesOfFrame> people;
    vision::FloorView view;
    std::map<std::uint32_t, PetsWay> ways;
    Site site;
    papers::Way posts_m;
};

inline std::optional<Eigen::Vector2d> on_floor(const vision::FloorView& view, const Eigen::Vector2d& px) {
    const auto point = vision::foot_on_floor(view, {px, Eigen::Matrix2d::Identity()});
    return point ? std::optional(point->position_site_m) : std::nullopt;
}

inline Site anchors_around(const std::map<std::uint32_t, PetsWay>& ways) {
    Eigen::Array2d least(1e9, 1e9), most(-1e9, -1e9);
    for (const auto& [person, way] : ways)
        for (const auto& [time_s, place_m] : way.places_m()) {
            least = least.min(place_m.array());
            most = most.max(place_m.array());
        }
    constexpr double outside_m = 1, high_m = 3;
    least -= outside_m;
    most += outside_m;
    return papers::site_of({{least.x(), least.y(), high_m},
                            {most.x(), least.y(), high_m},
                            {most.x(), most.y(), high_m},
                            {least.x(), most.y(), high_m}});
}

/// Nothing where the data are not.
inline std::optional<PetsScene> pets_scene() {
    PetsScene scene;
    scene.people = annotations("PETS2009-S2L1.xml");
    const auto calibration = recorded("pets2009/data/calibration/View_001.xml");
    if (scene.people.empty() || !calibration || !recorded("mot15_sort_det/PETS09-S2L1/det/det.txt")) return {};
    std::vector<ConfigProblem> problems;
    const auto camera = config::load_camera(calibration->string(), problems);
    if (!camera) return {};
    scene.view = camera->view;
    for (std::size_t frame = 0; frame < scene.people.size(); ++frame)
        for (const auto& person : scene.people[frame])
            if (const auto place_m = on_floor(scene.view, foot_of(person.box)); place_m.has_value())
                scene.ways[person.id].add(frame, place_m.value());
    scene.site = anchors_around(scene.ways);
    constexpr std::array<std::array<double, 2>, 2> post_feet_px{{{433, 391}, {745, 223}}};
    for (const auto& px : post_feet_px)
        if (const auto place_m = on_floor(scene.view, {px[0], px[1]}); place_m.has_value())
            scene.posts_m.push_back(place_m.value());
    return scene;
}

/// What the tracker shows in one frame: its foot points, and whose box each track's is by the annotations.
struct PetsImage {
    std::vector<Measurement> feet;
    std::map<std::uint32_t, std::uint32_t> person_of; ///< of a track
};

inline std::vector<PetsImage> pets_images(const PetsScene& scene,
                                          const std::vector<std::vector<vision::Detection>>& detections) {
    vision::Tracker tracker({}, scene.view);
    TrackingScorer scorer;
    std::vector<PetsImage> images;
    for (std::size_t frame = 0; frame < scene.people.size(); ++frame) {
        PetsImage& image = images.emplace_back();
        const Timestamp time = timestamp_from_s(pets_time_s(frame));
        BoxesOfFrame boxes;
        for (const auto& track : tracker.update(time, detections[frame])) {
            boxes.push_back({track.id, track.box});
            const auto at = vision::stands_at(scene.view, track, {});
            if (!at.has_value() || track.unseen_s > 0) continue; // a prediction is no measurement
            const Eigen::Matrix2f m2 = at.value().covariance_m2.cast<float>();
            const Vec2 place_m{at.value().position_site_m.x(), at.value().position_site_m.y()};
            image.feet.push_back(
                {time, 0, 1,
                 FootPoint{address(0), track.id, place_m, {m2(0, 0), m2(0, 1), m2(1, 1)}, unknown_f, track.looks}});
        }
        for (const auto& [person, box] : scorer.add(scene.people[frame], boxes))
            image.person_of[boxes[box].id] = scene.people[frame][person].id;
    }
    return images;
}

} // namespace locus::test
