#include "fusion/estimators/inertial_ekf.h"

#include <algorithm>
#include <cmath>

namespace locus {
namespace {

/// The aided filter comes in, and goes, over this time: no jump.
constexpr double change_over_s = 1;
/// The comparison remembers this long, and at least so many innovations.
constexpr double memory_s = 1, memory = 200;
/// Ratio of mean squares above which the aided filter predicts worse: sound sensors stay below 1.15 on recordings,
/// shaken ones go above 1.35 within seconds. While it only aligns it does no harm, and an outage may leave it further
/// off.
constexpr double worse = 1.25, much_worse = 4;
/// How long the aided filter must have done well before it is published; twice as long after each time it was not.
constexpr double first_probation_s = 1, longest_probation_s = 600;
constexpr double clip_sigma = 3;

} // namespace

InertialEkf::InertialEkf(const Site& site, const InertialEkfSettings& settings)
    : settings_(settings), plain_(site, settings), aided_(site, settings), probation_s_(first_probation_s) {
    aided_.forget_after(std::max(settings.forget_after_s, settings.dead_reckoning_s));
}

Verdict InertialEkf::update(const Measurement& measurement) noexcept {
    if (std::holds_alternative<ImuSample>(measurement.observation)) return sense(measurement);
    const Verdict plain = plain_.update(measurement, !sensed_);
    if (!sensed_) return plain;
    const Verdict aided = aided_.update(measurement);
    weigh_up(plain, aided, measurement.time);
    return aided_share_ > 0.5 ? aided : plain;
}

Verdict InertialEkf::see(const AlignedPlace& place, const Measurement& odometry) noexcept {
    const Verdict plain = plain_.see(place, odometry, !sensed_);
    if (!sensed_) return plain;
    const Verdict aided = aided_.see(place, odometry);
    weigh_up(plain, aided, odometry.time);
    return aided_share_ > 0.5 ? aided : plain;
}

void InertialEkf::weigh_up(const Verdict& plain, const Verdict& aided, Timestamp time) noexcept {
    compare(plain, aided, to_s(time - compared_));
    compared_ = time;
    turn_to_the_better(time);
}

Verdict InertialEkf::sense(const Measurement& measurement) noexcept {
    if (!settings_.use_imu || settings_.planar) return {Exclusion::disabled}; // nothing would hold the height
    if (!sensed_) {
        aided_.restart_from(plain_.brisk());
        resets_ = resets_seen_ = plain_.brisk().reset_count();
    }
    sensed_ = true;
    const Verdict verdict = aided_.update(measurement);
    turn_to_the_better(measurement.time);
    return verdict;
}

void InertialEkf::compare(const Verdict& plain, const Verdict& aided, double dt_s) noexcept {
    if (!std::isfinite(plain.innovation) || !std::isfinite(aided.innovation)) return;
    const double limit = clip_sigma * std::min(double{plain.innovation_sigma}, double{aided.innovation_sigma});
    const double fresh = std::min(-std::expm1(-dt_s / memory_s), 1 / memory);
    const auto learn = [limit, fresh](double& mean, float innovation) {
        const double clipped = std::min(std::abs(double{innovation}), limit);
        mean += fresh * (clipped * clipped - mean);
    };
    learn(misfit_plain_, plain.innovation);
    learn(misfit_aided_, aided.innovation);
}

bool InertialEkf::aided_is_worse() const noexcept {
    return plain_.brisk().has_position() &&
           (!aided_.has_position() ||
            misfit_aided_ > (aided_.track().is_inertial() ? worse : much_worse) * misfit_plain_);
}

void InertialEkf::turn_to_the_better(Timestamp time) noexcept {
    const double dt_s = std::clamp(to_s(time - time_), 0.0, 1.0);
    time_ = time;
    if (aided_is_worse()) start_aided_again();
    done_well_s_ = aided_.track().is_inertial() ? done_well_s_ + dt_s : 0;
    const double step = dt_s / change_over_s;
    aided_share_ = std::clamp(aided_share_ + (done_well_s_ > probation_s_ ? step : -step), 0.0, 1.0);
    count_resets();
}

/// Clients see one counter that never falls, whichever filter is published.
void InertialEkf::count_resets() noexcept {
    const std::uint32_t now = (aided_share_ > 0.5 ? aided_ : plain_.brisk()).reset_count();
    if (now > resets_seen_) resets_ += now - resets_seen_;
    resets_seen_ = now;
}

void InertialEkf::start_aided_again() noexcept {
    if (aided_.track().is_inertial()) probation_s_ = std::min(2 * probation_s_, longest_probation_s);
    aided_.restart_from(plain_.brisk());
    misfit_aided_ = misfit_plain_;
}

Estimate InertialEkf::predict(Timestamp time) const noexcept {
    const bool aided = aided_share_ > 0 && aided_.has_position();
    const bool plain = !aided || (aided_share_ < 1 && plain_.brisk().has_position());
    Estimate estimate = plain ? plain_.predict(time) : aided_.predict(time);
    if (plain && aided) estimate = mixed(estimate, aided_.predict(time), aided_share_);
    if (sensed_) estimate.reset_count = resets_;
    if (estimate.missing == Missing::nothing && is_out_of_date(time)) estimate.missing = Missing::fresh_measurements;
    return estimate;
}

/// Other sources keep the target heard, but where it is goes stale all the same.
bool InertialEkf::is_out_of_date(Timestamp time) const noexcept {
    const double believed_s = aided_share_ > 0.5 ? settings_.dead_reckoning_s : settings_.forget_after_s;
    const double unheard_s =
        std::min(plain_.brisk().unheard_s(time), aided_.has_position() ? aided_.unheard_s(time) : no_limit);
    return unheard_s > believed_s;
}

std::unique_ptr<Estimator> make_inertial_ekf(const Site& site, const void* settings) {
    return std::make_unique<InertialEkf>(site, *static_cast<const InertialEkfSettings*>(settings));
}

} // namespace locus
