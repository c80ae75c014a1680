// Where a camera is a moment later if it goes on as it went: constant turn and speed, in its own axes.
#pragma once

#include "drivers/camera/odometry/camera_pose.h"
#include "fusion/time.h"

#include <algorithm>

namespace locus::camera {

class MotionGuess {
  public:
    void restart(const CameraPose& pose, Timestamp time) {
        pose_ = pose;
        time_ = time;
        step_ = {};
        step_s_ = 0;
    }

    void add(const CameraPose& pose, Timestamp time) {
        step_ = pose * pose_.inverse();
        step_s_ = to_s(time - time_);
        pose_ = pose;
        time_ = time;
    }

    CameraPose at(Timestamp time) const {
        if (!(step_s_ > 0)) return pose_;
        const double share = std::min(to_s(time - time_) / step_s_, most_steps);
        const Eigen::AngleAxisd turn(step_.camera_from_map);
        const CameraPose step{Eigen::Quaterniond(Eigen::AngleAxisd(share * turn.angle(), turn.axis())),
                              share * step_.map_in_camera};
        return step * pose_;
    }

    Timestamp last() const { return time_; }

  private:
    /// A walker turns on for no longer than that.
    static constexpr double most_steps = 3;

    CameraPose pose_, step_;
    Timestamp time_{};
    double step_s_ = 0;
};

} // namespace locus::camera
