#include "fusion/inertial/levelling.h"

#include "fusion/geometry/rotation.h"
#include "fusion/units.h"

#include <algorithm>
#include <cmath>

namespace locus::inertial {

void Levelling::carry(const Rates& rates, double dt_s) noexcept {
    if (observed_s_ == 0) body_to_level_ = levelled(rates.specific_force_mps2);
    observed_s_ += dt_s;
    body_to_level_ = body_to_level_ * rotation(rates.angular_rate_radps * dt_s);
    const Eigen::Vector3d up = body_to_level_ * rates.specific_force_mps2 / standard_gravity_mps2;
    const double share = dt_s / std::min(observed_s_, memory_s);
    body_to_level_ = rotation(share * up.cross(Eigen::Vector3d::UnitZ())) * body_to_level_;
    body_to_level_.normalize();
}

void Levelling::continue_from(const Eigen::Quaterniond& body_to_level) noexcept {
    body_to_level_ = body_to_level;
    observed_s_ = memory_s;
}

double Levelling::tilt_sigma_rad(double speed_sigma_mps, double bias_sigma_mps2) const noexcept {
    const double mean_acceleration_mps2 = speed_sigma_mps / std::clamp(observed_s_, 0.1, memory_s);
    return std::hypot(mean_acceleration_mps2, bias_sigma_mps2) / standard_gravity_mps2;
}

} // namespace locus::inertial
