// The scenario's truth: where every target is at a time, and which walls stand between it and an anchor.
#pragma once

#include "tools/simulate/path.h"
#include "tools/simulate/scenario.h"

namespace locus::simulate {

struct TruePose {
    Eigen::Vector3d position_site_m;
    double heading_rad = 0; ///< of the motion, anticlockwise from the x axis
};

class Target {
  public:
    explicit Target(const Motion& motion);
    TruePose at(double time_s) const;

  private:
    Path path_;
    double speed_mps_;
    double sway_m_;
    double start_m_;
};

/// Whether the straight line from a to b meets the wall.
bool crosses(const Wall& wall, const Eigen::Vector3d& a_site_m, const Eigen::Vector3d& b_site_m);

} // namespace locus::simulate
