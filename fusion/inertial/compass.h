// When a magnetometer may be believed. Steel and currents bend the field indoors; what bends its direction mostly
// changes its strength or its dip as well (Afzal, Renaudin, Lachapelle 2011, "Use of Earth's magnetic field for
// mitigating gyroscope errors regardless of magnetic perturbation"). So a field that is not as strong and as steep as
// the one known is let pass. Where north lies is not asked: the first trusted field says it, and every later one shows
// how far the heading has drifted since.
#pragma once

#include <Eigen/Core>

#include <optional>

namespace locus::inertial {

struct CompassSettings {
    double strength_tolerance = 0.1; ///< of the field known; more is a disturbance
    double dip_tolerance_rad = 0.09; ///< 5 deg
    double quiet_s = 0.5;            ///< undisturbed for this long before it is believed
    double learning_s = 20;          ///< in which the field known follows
    double spacing_s = 1;            ///< between two answers: closer ones share one disturbance
    double sigma_rad = 0.2;          ///< of a field that passes, indoors: 11 deg
};

class Compass {
  public:
    explicit Compass(const CompassSettings& settings) : settings_(settings) {}

    /// Takes the field in the level frame, microtesla, `dt_s` after the last one. An answer: by how much the heading is
    /// more than it was taken for, rad, at CompassSettings::sigma_rad.
    std::optional<double> hear(const Eigen::Vector3d& field_level_ut, double dt_s) noexcept;

    double sigma_rad() const noexcept { return settings_.sigma_rad; }

  private:
    struct Field {
        double strength_ut = 0;
        double dip_rad = 0;
    };
    bool fits(const Field& field) const noexcept;
    void learn(const Field& field, double dt_s) noexcept;

    CompassSettings settings_;
    std::optional<Field> known_;
    std::optional<double> first_azimuth_rad_;
    double quiet_s_ = 0;
    double since_answer_s_ = 0;
};

} // namespace locus::inertial
