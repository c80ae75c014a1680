// Somebody who walks round a room with a camera on the body, at truth that is known: along a rectangle with round
// corners, looking ahead and a little down, the head going up and down with each step and from side to side with every
// second one.
#pragma once

#include "tests/support/room/room_scene.h"

#include <cmath>
#include <numbers>

namespace locus::room {

struct WalkSettings {
    Eigen::Vector2d room_m{9, 7};
    double from_wall_m = 1.4;
    double corner_m = 0.8; ///< radius
    double speed_mps = 1.2;
    double height_m = 1.5, down_rad = 0.1;
    double bob_m = 0.025, step_hz = 1.8; ///< Inman 1981: about 5 cm from lowest to highest
    double sway_m = 0.02, nod_rad = 0.01, yaw_rad = 0.02;
};

class RoomWalk {
  public:
    explicit RoomWalk(const WalkSettings& settings = {}) : settings_{settings} {}

    double round_m() const { return 2 * (side().x() + side().y()) + 2 * std::numbers::pi * settings_.corner_m; }
    double speed_mps() const { return settings_.speed_mps; }

    RoomView at(double time_s) const {
        const auto [place, heading_rad] = on_rectangle(std::fmod(settings_.speed_mps * time_s, round_m()));
        const double step = 2 * std::numbers::pi * settings_.step_hz * time_s;
        const double yaw_rad = heading_rad + settings_.yaw_rad * std::sin(step / 2 + 1);
        const Eigen::Vector2d left(-std::sin(heading_rad), std::cos(heading_rad));
        const Eigen::Vector2d swayed = place + settings_.sway_m * std::sin(step / 2) * left;
        const double down_rad = settings_.down_rad + settings_.nod_rad * std::sin(step + 0.5);
        const double roll_rad = settings_.nod_rad * std::sin(step / 2 + 2);
        return {{swayed.x(), swayed.y(), settings_.height_m + settings_.bob_m * std::sin(step)},
                looking(yaw_rad, down_rad, roll_rad)};
    }

  private:
    struct Place {
        Eigen::Vector2d at_m;
        double heading_rad;
    };

    Eigen::Vector2d side() const { return settings_.room_m.array() - 2 * (settings_.from_wall_m + settings_.corner_m); }

    /// Against the clock, from the middle of the first side's beginning.
    Place on_rectangle(double gone_m) const {
        const double quarter_m = 0.5 * std::numbers::pi * settings_.corner_m;
        Eigen::Vector2d at(settings_.from_wall_m + settings_.corner_m, settings_.from_wall_m);
        double heading_rad = 0;
        for (int i = 0;; ++i) {
            const double side_m = side()[i % 2];
            const Eigen::Vector2d ahead(std::cos(heading_rad), std::sin(heading_rad)), left(-ahead.y(), ahead.x());
            if (gone_m <= side_m) return {at + gone_m * ahead, heading_rad};
            gone_m -= side_m;
            at += side_m * ahead;
            const double angle_rad = std::min(gone_m, quarter_m) / settings_.corner_m;
            const Eigen::Vector2d turned =
                settings_.corner_m * (std::sin(angle_rad) * ahead + (1 - std::cos(angle_rad)) * left);
            if (gone_m <= quarter_m) return {at + turned, heading_rad + angle_rad};
            gone_m -= quarter_m;
            at += turned;
            heading_rad += std::numbers::pi / 2;
        }
    }

    static Eigen::Quaterniond looking(double yaw_rad, double down_rad, double roll_rad) {
        Eigen::Matrix3d level; // camera's right, down and forward, for a heading along x
        level.col(0) = -Eigen::Vector3d::UnitY();
        level.col(1) = -Eigen::Vector3d::UnitZ();
        level.col(2) = Eigen::Vector3d::UnitX();
        return Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) * Eigen::Quaterniond(level) *
               Eigen::AngleAxisd(-down_rad, Eigen::Vector3d::UnitX()) *
               Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ());
    }

    WalkSettings settings_;
};

} // namespace locus::room
