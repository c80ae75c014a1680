// One axis of a box: two edges of a body that moves steadily and hardly changes its size. A detector errs at each edge
// by itself, so each is a measurement of its own: whose feet are hidden is held by his head, and whose head is seen
// well has surer feet.
#pragma once

#include <Eigen/Core>

namespace locus::vision {

class Extent {
  public:
    using Edges = Eigen::Vector2d; ///< lower coordinate, higher coordinate, px

    /// `anchor`: where between the edges the steady point is, 0 at the lower one, 1 at the higher.
    Extent(const Edges& edges_px, double anchor, double edge_variance_px2, double start_variance_px2ps2) noexcept;

    /// Densities of white noise: of the acceleration (px^2/s^3) and of the size's wandering (px^2/s).
    void predict(double dt_s, double acceleration_density, double wander_density) noexcept;
    void update(const Edges& measured_px, double edge_variance_px2) noexcept;
    void update_lower(double measured_px, double edge_variance_px2) noexcept;

    double place_px() const noexcept { return state_(0); }
    double place_variance_px2() const noexcept { return covariance_(0, 0); }
    double size_px() const noexcept { return state_(2); }
    double lower_px() const noexcept { return state_(0) - anchor_ * state_(2); }
    double lower_variance_px2() const noexcept;

    /// Of measured edges, with S the covariance of the innovation and R that of the edges.
    struct Distance {
        double mahalanobis2;
        double log_doubt; ///< ln(det S / det R): how much wider the track makes the gate
    };
    Distance distance(const Edges& measured_px, double edge_variance_px2) const noexcept;

  private:
    using Row = Eigen::Vector3d;
    double anchor_;
    Eigen::Vector3d state_; ///< place, its rate, size
    Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();

    Row lower_row() const noexcept { return {1, 0, -anchor_}; }
    Row higher_row() const noexcept { return {1, 0, 1 - anchor_}; }
    void take_in(const Row& row, double measured_px, double variance_px2) noexcept;
};

} // namespace locus::vision
