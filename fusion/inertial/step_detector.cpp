#include "fusion/inertial/step_detector.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace locus::inertial {
namespace {

/// A silence longer than this begins anew: nothing is known of what lay between.
constexpr double longest_gap_s = 0.5;

void approach(double& state, double target, double share) { state += share * (target - state); }

} // namespace

double StepDetector::delay_s() const noexcept { return 2 / (2 * std::numbers::pi * settings_.low_pass_hz); }

double StepDetector::band_limited(double force_mps2, double dt_s) noexcept {
    const double low_share = -std::expm1(-dt_s * 2 * std::numbers::pi * settings_.low_pass_hz);
    approach(mean_, force_mps2, -std::expm1(-dt_s / settings_.mean_time_s));
    approach(low_, force_mps2 - mean_, low_share);
    approach(lower_, low_, low_share);
    return lower_;
}

double StepDetector::threshold_mps2() const noexcept {
    return std::max(settings_.least_peak_mps2, settings_.peak_share * usual_peak_);
}

std::optional<Stride> StepDetector::hear(Timestamp time, double force_mps2) noexcept {
    const double dt_s = last_time_ ? to_s(time - *last_time_) : longest_gap_s + 1;
    last_time_ = time;
    if (dt_s > longest_gap_s) {
        mean_ = force_mps2;
        low_ = lower_ = value_ = wave_peak_ = highest_ = lowest_ = usual_peak_ = 0;
        last_step_.reset();
        return std::nullopt;
    }
    const double before = value_;
    value_ = band_limited(force_mps2, dt_s);
    usual_peak_ *= std::exp(-dt_s / settings_.memory_s);
    highest_ = std::max(highest_, value_);
    lowest_ = std::min(lowest_, value_);
    if (value_ > wave_peak_) {
        wave_peak_ = value_;
        wave_time_ = time;
    }
    if (before <= 0 || value_ > 0) return std::nullopt;
    const bool high = wave_peak_ >= threshold_mps2();
    const bool apart = !last_step_ || to_s(wave_time_ - *last_step_) >= settings_.refractory_s;
    if (high && apart) return finish();
    wave_peak_ = 0;
    return std::nullopt;
}

Stride StepDetector::finish() noexcept {
    const double since_s = last_step_ ? to_s(wave_time_ - *last_step_) : settings_.longest_s + 1;
    const double duration_s = since_s <= settings_.longest_s ? since_s : settings_.first_duration_s;
    const Stride stride{wave_time_ - duration_from_s(delay_s()), duration_s, highest_ - lowest_};
    usual_peak_ = std::max(usual_peak_, 0.0) + 0.5 * (wave_peak_ - usual_peak_);
    last_step_ = wave_time_;
    highest_ = lowest_ = wave_peak_ = 0;
    return stride;
}

} // namespace locus::inertial
