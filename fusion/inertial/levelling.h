// Which way is up, before anything else is known: the attitude against a frame that is level and whose heading is
// anybody's guess. The gyroscope carries it; the specific force, averaged in that frame, shows the vertical, because
// whoever stays on a site has no lasting acceleration.
#pragma once

#include "fusion/inertial/held_imu.h"

#include <Eigen/Geometry>

namespace locus::inertial {

class Levelling {
  public:
    /// `rates` held for the last `dt_s`.
    void carry(const Rates& rates, double dt_s) noexcept;
    void forget() noexcept { *this = {}; }
    /// An attitude that was found otherwise; its heading becomes the level frame's.
    void continue_from(const Eigen::Quaterniond& body_to_level) noexcept;

    /// Long enough observed that a start in motion has averaged out somewhat.
    bool is_level() const noexcept { return observed_s_ >= 1; }

    /// Of the two tilt angles, rad, for a target that changes its velocity by about `speed_sigma_mps`, and whose
    /// accelerometer is off by `bias_sigma_mps2`.
    double tilt_sigma_rad(double speed_sigma_mps, double bias_sigma_mps2) const noexcept;

    const Eigen::Quaterniond& body_to_level() const noexcept { return body_to_level_; }

  private:
    static constexpr double memory_s = 10;
    Eigen::Quaterniond body_to_level_ = Eigen::Quaterniond::Identity();
    double observed_s_ = 0;
};

} // namespace locus::inertial
