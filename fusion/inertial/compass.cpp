#include "fusion/inertial/compass.h"

#include <cmath>
#include <numbers>

namespace locus::inertial {
namespace {

/// A field this weak along the floor points nowhere.
constexpr double least_horizontal_ut = 5;

} // namespace

std::optional<double> Compass::hear(const Eigen::Vector3d& field_level_ut, double dt_s) noexcept {
    const double horizontal_ut = field_level_ut.head<2>().norm();
    if (!field_level_ut.allFinite() || horizontal_ut < least_horizontal_ut) return std::nullopt;
    const Field field{field_level_ut.norm(), std::atan2(-field_level_ut.z(), horizontal_ut)};
    since_answer_s_ += dt_s;
    quiet_s_ = fits(field) ? quiet_s_ + dt_s : 0;
    learn(field, dt_s);
    if (quiet_s_ < settings_.quiet_s || since_answer_s_ < settings_.spacing_s) return std::nullopt;
    since_answer_s_ = 0;
    const double azimuth_rad = std::atan2(field_level_ut.y(), field_level_ut.x());
    if (!first_azimuth_rad_) {
        first_azimuth_rad_ = azimuth_rad;
        return std::nullopt;
    }
    return std::remainder(*first_azimuth_rad_ - azimuth_rad, 2 * std::numbers::pi);
}

bool Compass::fits(const Field& field) const noexcept {
    return known_ && std::abs(field.strength_ut / known_->strength_ut - 1) < settings_.strength_tolerance &&
           std::abs(field.dip_rad - known_->dip_rad) < settings_.dip_tolerance_rad;
}

/// It follows also what does not fit, slowly: else a first field beside a steel door would be the measure for ever.
void Compass::learn(const Field& field, double dt_s) noexcept {
    if (!known_) known_ = field;
    const double share = -std::expm1(-dt_s / settings_.learning_s);
    known_->strength_ut += share * (field.strength_ut - known_->strength_ut);
    known_->dip_rad += share * (field.dip_rad - known_->dip_rad);
}

} // namespace locus::inertial
