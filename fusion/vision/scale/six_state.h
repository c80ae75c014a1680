// The filter of paper 001, section 2.3 (eq. 21-33), to compare with: place in the plane, speed, heading, scale of the
// vision, and deflection angle between the vision's plane and the site's. Two things of the print cannot be meant:
// - the transition matrix (eq. 24) moves the place by v sin(heading) and v cos(heading) without the time between two
//   steps, as if that were always one second; here each is multiplied by it. Its heading counts from the y axis.
// - it predicts with matrices that stand for a linear model (eq. 29-30) though heading and speed multiply; here the
//   Jacobian of eq. 27 is that of the model.
// The observation of vision (eq. 26) lacks a row for the scale; it is read as the place of the vision's own frame,
// turned by the deflection and multiplied by the scale, about the place where vision began.
#pragma once

#include <Eigen/Core>

namespace locus::vision {

/// Standard deviations; per root of a second where a state walks. The paper states none.
struct SixStateModel {
    double speed_walk_mps2 = 0.5;
    double heading_walk_rads = 0.7;
    double scale_walk = 0.01; ///< relative
    double deflection_walk_rads = 0.01;
    double start_speed_mps = 1, start_heading_rad = 2, start_scale = 0.5, start_deflection_rad = 1;
};

class SixState {
  public:
    enum Place : int { x_at, y_at, speed_at, heading_at, scale_at, deflection_at };
    using State = Eigen::Matrix<double, 6, 1>;
    using Covariance = Eigen::Matrix<double, 6, 6>;

    /// `start`: a first guess of all six, the place within `place_sigma_m`.
    SixState(const SixStateModel& model, const State& start, double place_sigma_m);

    /// Eq. 29-30. `dt_s` >= 0.
    void predict(double dt_s);
    /// Eq. 25, then 31-33.
    void hear(const Eigen::Vector2d& place_site_m, double sigma_m);
    /// Eq. 26: the vision's place against the one where it began, and where that lies in the site; in vision's units.
    void see(const Eigen::Vector2d& since_begin_odometry, const Eigen::Vector2d& begin_site_m, double sigma_m);

    const State& state() const { return state_; }
    const Covariance& covariance() const { return covariance_; }

  private:
    void update(const Eigen::Vector2d& innovation_m, const Eigen::Matrix<double, 2, 6>& jacobian, double sigma_m);

    SixStateModel model_;
    State state_;
    Covariance covariance_;
};

} // namespace locus::vision
