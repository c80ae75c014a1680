#include "fusion/inertial/step_length.h"

#include <algorithm>
#include <cmath>

namespace locus::inertial {

double step_length_m(const StepLengthSettings& settings, double amplitude_mps2) noexcept {
    return std::min(longest_step_m, settings.factor * std::sqrt(std::sqrt(std::max(0.0, amplitude_mps2))));
}

} // namespace locus::inertial
