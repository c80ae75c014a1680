// Gait: from a walker's inertial samples to the move that all particles make. Steps are told after they are made; until
// the next one the walker is taken to go on as in the last, and when it is told, what was too much or too little is
// made good. So positions go smoothly at any rate, and over many steps only the steps count.
#pragma once

#include "fusion/filter/particles.h"
#include "fusion/inertial/pedestrian.h"

namespace locus {

struct GaitSettings {
    inertial::PedestrianSettings pedestrian;
    double course_wander_rad_rts = 0.03;
    double shuffle_m_rts = 0.05; ///< moving about without steps: turning on the spot, leaning
};

class Gait {
  public:
    explicit Gait(const GaitSettings& settings) : settings_(settings), pedestrian_(settings.pedestrian) {}

    void hear(const ImuSample& sample, Timestamp time) noexcept;

    /// Whether steps are known well enough to move by: the unit is heard, and at least two steps in a row were.
    bool leads() const noexcept { return leads_; }
    /// Whether the unit was heard lately.
    bool heard(Timestamp time) const noexcept;

    /// What has gathered since the last call.
    filter::ParticleMove take() noexcept;
    /// The same without taking it, and gone on to `time`.
    Eigen::Vector2d outlook(Timestamp time) const noexcept;
    double place_variance_m2() const noexcept { return place_variance_m2_; }

    /// Metres of a mean person in a second, in the direction of the unit's heading.
    Eigen::Vector2d speed_mps() const noexcept { return speed_mps_ * facing(pedestrian_.heading_rad()); }

  private:
    static Eigen::Vector2d facing(double heading_rad) noexcept;
    void go_on(double dt_s) noexcept;
    void make_good(const inertial::Step& step) noexcept;
    void stop() noexcept;

    GaitSettings settings_;
    inertial::Pedestrian pedestrian_;
    Timestamp time_{}; ///< of the last sample
    Timestamp told_{}; ///< when the last step was told
    bool any_sample_ = false;
    bool leads_ = false;
    int steps_in_a_row_ = 0;
    double speed_mps_ = 0;
    double step_s_ = 0; ///< duration of the last step
    double gone_m_ = 0; ///< since the last step was told
    Eigen::Vector2d gathered_m_{0, 0};
    double place_variance_m2_ = 0;
    double turn_variance_rad2_ = 0;    ///< of the course against the unit, gathered
    double heading_variance_rad2_ = 0; ///< of the unit, when last taken
};

} // namespace locus
