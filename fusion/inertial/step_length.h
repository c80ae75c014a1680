// Length of a step from how hard the body bounces: a leg is an inverted pendulum, so the longer the step the higher the
// hip rises and falls (Weinberg 2002, Analog Devices AN-602): length = K (a_max - a_min)^(1/4).
// How much longer one person's steps are than a mean person's is for the filter behind to learn, which sees both steps
// and places.
#pragma once

namespace locus::inertial {

/// Factor and person_sigma: 37 walks of phones in hands between surveyed points, 1.1 km (indoor_location_competition,
/// one floor); walks longer than 20 m spread by 7 %, other ways of wearing by more (Weinberg names none).
struct StepLengthSettings {
    double factor = 0.43;       ///< K for the band-limited force of StepDetector, m per (m/s^2)^(1/4)
    double person_sigma = 0.15; ///< relative: from one person, and way of wearing, to another
    double step_sigma = 0.08;   ///< relative: from one step to the next of one person
};

inline constexpr double longest_step_m = 2.5;

/// Length that a mean person's step has, m. Zero where nothing bounced.
double step_length_m(const StepLengthSettings& settings, double amplitude_mps2) noexcept;

} // namespace locus::inertial
