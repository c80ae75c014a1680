// Somebody with a tag who strolls about before a camera, others who do the same, and what the tag's poses and the
// camera say of it: feet with noise and with detections that are none, poses with an error that lasts, clocks that are
// apart.
#pragma once

#include "fusion/vision/survey/walk_fit.h"
#include "tests/unit/fusion/vision/cameras.h"

#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace locus::vision_test {

struct WalkOptions {
    unsigned seed = 1;
    double duration_s = 90;
    double offset_s = 0.37; ///< camera time + offset = time of the poses
    double foot_sigma_px = 4;
    double pose_sigma_m = 0.1; ///< lasts for half a second
    double wrong_share = 0.1;  ///< of the feet: anywhere in the image
    unsigned others = 0;       ///< people without a tag
    bool on_a_line = false;
};

struct SimulatedWalk {
    std::vector<vision::survey::SeenFoot> feet;
    std::vector<vision::survey::PathPoint> path;
};

/// 4 m to 14 m in front of looking_down()'s camera: about where its image shows the floor.
class Stroll {
  public:
    explicit Stroll(std::mt19937& random, bool on_a_line) : on_a_line_(on_a_line) {
        std::uniform_real_distribution<double> any(0, 1);
        for (int i = 0; i < 200; ++i) goals_m_.emplace_back(-4 + 8 * any(random), 4 + 10 * any(random));
        at_m_ = goals_m_[0];
    }
    /// 1.2 m/s from goal to goal, round the corners.
    Eigen::Vector2d step(double dt_s) {
        const Eigen::Vector2d way_m = goals_m_[goal_] - at_m_;
        velocity_mps_ += std::min(1., dt_s / 0.4) * (1.2 * way_m.normalized() - velocity_mps_);
        at_m_ += dt_s * velocity_mps_;
        if (way_m.norm() < 0.6) ++goal_;
        return on_a_line_ ? Eigen::Vector2d(0.1 * at_m_.y(), at_m_.y()) : at_m_;
    }

  private:
    bool on_a_line_;
    std::vector<Eigen::Vector2d> goals_m_;
    std::size_t goal_ = 1;
    Eigen::Vector2d at_m_{0, 0}, velocity_mps_{0, 0};
};

inline SimulatedWalk simulate_walk(const vision::FloorView& camera, const WalkOptions& options) {
    constexpr double step_s = 0.02; // poses 50 a second, images 10
    std::mt19937 random(options.seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> any(0, 1);
    std::vector<Stroll> people;
    for (unsigned i = 0; i <= options.others; ++i) people.emplace_back(random, options.on_a_line && i == 0);
    const double kept = std::exp(-step_s / 0.5), fresh = std::sqrt(1 - kept * kept);
    Eigen::Vector2d error_m(normal(random), normal(random));
    SimulatedWalk walk;
    for (int i = 0; i * step_s < options.duration_s; ++i) {
        const double pose_time_s = 1000 + i * step_s;
        error_m = kept * error_m + fresh * Eigen::Vector2d(normal(random), normal(random));
        for (unsigned who = 0; who < people.size(); ++who) {
            const Eigen::Vector2d at_m = people[who].step(step_s);
            if (who == 0) walk.path.push_back({pose_time_s, at_m + options.pose_sigma_m * error_m});
            const auto pixel = vision::pixel_of_floor(camera, at_m);
            if (i % 5 != 0 || !pixel) continue;
            Eigen::Vector2d seen_px = *pixel + options.foot_sigma_px * Eigen::Vector2d(normal(random), normal(random));
            if (any(random) < options.wrong_share) seen_px = {1280 * any(random), 720 * any(random)};
            const bool is_in_image = (seen_px.array() > 0).all() && seen_px.x() < 1280 && seen_px.y() < 720;
            // numbers change now and then, as trackers do
            const auto track = 100 * who + static_cast<unsigned>(i * step_s / 31);
            if (is_in_image) walk.feet.push_back({pose_time_s - options.offset_s, track, seen_px, 6});
        }
    }
    return walk;
}

} // namespace locus::vision_test
