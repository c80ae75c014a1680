// Whether the sensor lies still, and what its gyroscope says then: that is its bias. A bias of half a degree a second,
// usual before calibration, turns a heading round in minutes.
#pragma once

#include "fusion/inertial/held_imu.h"

#include <optional>

namespace locus::inertial {

class Rest {
  public:
    /// `rates` held for the last `dt_s`.
    void carry(const Rates& rates, double dt_s) noexcept;
    void forget() noexcept { *this = {}; }

    /// Nothing has moved for half a second, by what consumer sensors show on a table and no hand or machine keeps up.
    bool is_at_rest() const noexcept;

    /// The bias found at the last rest.
    const std::optional<Eigen::Vector3d>& gyroscope_bias_radps() const noexcept { return bias_radps_; }

  private:
    Eigen::Vector3d mean_force_mps2_{0, 0, 0}, mean_rate_radps_{0, 0, 0};
    double force_variance_ = 0, rate_variance_ = 0;
    double watched_s_ = 0;
    std::optional<Eigen::Vector3d> bias_radps_;
};

} // namespace locus::inertial
