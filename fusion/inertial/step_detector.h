// Steps of a walker in what an accelerometer at the waist, in a pocket or in a hand feels. The size of the specific
// force rises and falls once a step, whichever way the device is held; band-limited, each step is one wave above zero.
#pragma once

#include "fusion/time.h"

#include <optional>

namespace locus::inertial {

/// Walking is 1.4 to 2.5 steps a second, running up to 3.5 (Oberg et al. 1993). A device that is carried with care at
/// half a metre a second feels peaks of 0.2 to 0.4 m/s^2 (isas_walk), an ordinary walk ten times as much: there the
/// share of the usual peak is what decides.
struct StepDetectorSettings {
    double low_pass_hz = 3;         ///< twice in a row
    double mean_time_s = 0.6;       ///< of the mean that is taken off
    double least_peak_mps2 = 0.2;   ///< below, nobody walks
    double peak_share = 0.4;        ///< of the peaks that came lately: what a step's peak must reach
    double memory_s = 2;            ///< in which peaks are forgotten when no step comes
    double refractory_s = 0.25;     ///< between two steps
    double longest_s = 1.2;         ///< a step that lasts longer begins a new walk
    double first_duration_s = 0.55; ///< taken for the first step of a walk
};

/// One wave.
struct Stride {
    Timestamp time;            ///< of its peak, the filters' delay taken off
    double duration_s = 0;     ///< since the peak before
    double amplitude_mps2 = 0; ///< highest less lowest of the band-limited force since the last step
};

class StepDetector {
  public:
    explicit StepDetector(const StepDetectorSettings& settings) : settings_(settings) {}

    /// Takes |specific force|, m/s^2; times never go back. A step is told when its wave falls through zero.
    std::optional<Stride> hear(Timestamp time, double force_mps2) noexcept;

    /// Delay of the band-limited force behind the true one, s.
    double delay_s() const noexcept;

  private:
    double band_limited(double force_mps2, double dt_s) noexcept;
    double threshold_mps2() const noexcept;
    Stride finish() noexcept;

    StepDetectorSettings settings_;
    std::optional<Timestamp> last_time_;
    double mean_ = 0, low_ = 0, lower_ = 0; ///< states of the filters, m/s^2
    double value_ = 0;
    double usual_peak_ = 0;
    double highest_ = 0, lowest_ = 0; ///< since the last step
    double wave_peak_ = 0;
    Timestamp wave_time_{};
    std::optional<Timestamp> last_step_;
};

} // namespace locus::inertial
