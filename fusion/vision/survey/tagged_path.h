// Where the tagged person was over time: poses with straight lines between them.
#pragma once

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace locus::vision::survey {

struct PathPoint {
    double time_s = 0;
    Eigen::Vector2d site_m{0, 0};
};

/// Without a pose for so long nothing is known of the way between: at 1.4 m/s and with a turn in it that is half a
/// step.
inline constexpr double longest_gap_s = 0.5;

/// Over which velocity is taken: between two poses near to each other their errors would be most of it.
inline constexpr double velocity_base_s = 1;

class TaggedPath {
  public:
    /// Times increase.
    explicit TaggedPath(std::vector<PathPoint> points) : points_(std::move(points)) {}

    /// Position and velocity; empty outside of the path, in its gaps, and half a second to either side of both.
    struct State {
        Eigen::Vector2d site_m;
        Eigen::Vector2d velocity_mps;
    };
    std::optional<State> at(double time_s) const noexcept;

    const std::vector<PathPoint>& points() const { return points_; }

  private:
    std::optional<Eigen::Vector2d> position_m(double time_s) const noexcept;

    std::vector<PathPoint> points_;
};

} // namespace locus::vision::survey
