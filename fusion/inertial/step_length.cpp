#include "fusion/inertial/step_length.h"

#include <algorithm>
#include <cmath>

namespace locus::inertial {

double step_length_m(const StepLengthSettings& settings, double amplitude_mps2) noexcept {
    return std::min(longest_step_m, settings.factor * std::sqrt(std::sqrt(std::max(0.0, amplitude_mps2))));
}

StepFactor::StepFactor(const StepLengthSettings& settings) noexcept
    : variance_(settings.person_sigma * settings.person_sigma) {}

void StepFactor::learn(double walked_m, double measured_m, double sigma_m) noexcept {
    const double innovation_variance = walked_m * walked_m * variance_ + sigma_m * sigma_m;
    const double gain = variance_ * walked_m / innovation_variance;
    value_ += gain * (measured_m - value_ * walked_m);
    variance_ *= sigma_m * sigma_m / innovation_variance;
}

} // namespace locus::inertial
