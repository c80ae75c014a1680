#include "fusion/estimators/radio_particles.h"

#include "fusion/estimators/radio_grid.h"
#include "fusion/identity.h"

#include <algorithm>
#include <cmath>

namespace locus {
namespace {

/// The cloud moves at least this often, so that what lies ahead of it is a step at most.
constexpr double longest_radio_outlook_s = 0.5;
/// A reading this many standard deviations off happens one time in twenty.
constexpr float odd_sigmas = 2;

WalkingSettings radio_walking(const RadioParticlesSettings& s) {
    WalkingSettings walking;
    walking.particles.max_count = s.max_particles;
    walking.particles.min_count = s.min_particles;
    walking.particles.seed = static_cast<std::uint64_t>(s.seed);
    walking.gait.pedestrian.length.person_sigma = s.person_sigma;
    walking.gait.pedestrian.length.step_sigma = s.step_sigma;
    walking.gait.pedestrian.use_compass = s.use_compass;
    walking.gait.course_wander_rad_rts = s.course_wander_rad_rts;
    walking.velocity_time_s = s.speed_time_s;
    walking.velocity_wander_mps_rts = s.speed_sigma_mps * std::sqrt(2 / s.speed_time_s); // keeps the speed's variance
    walking.person_sigma = s.person_sigma;
    walking.height_m = s.height_m;
    walking.height_sigma_m = s.height_sigma_m;
    return walking;
}

radio::ReadingNoise reading_noise(const RadioParticlesSettings& s) {
    return {static_cast<float>(s.body_share), static_cast<float>(s.body_loss_db), static_cast<float>(s.outlier_share)};
}

/// Of a whole scan put side by side with the whole floor. What silence says there has no bound, so what is heard has
/// none either: else somebody who hears many beacons is thought to be where there are none.
radio::ReadingNoise of_scan(radio::ReadingNoise noise) {
    noise.outlier_share = 0;
    return noise;
}

} // namespace

RadioParticles::RadioParticles(const Site& site, const RadioParticlesSettings& settings)
    : site_(&site), settings_(settings), doubt_limit_(-std::log(settings.gate_false_alarm)),
      feet_gate_in_sigma_(std::sqrt(2 * doubt_limit_)), // chi-square of two degrees of freedom
      noise_(reading_noise(settings)),
      peer_loss_{settings.peer_power_1m_dbm, settings.exponent, settings.peer_sigma_db},
      grid_(make_radio_grid(site, settings)), posterior_(grid().cells().count(), of_scan(noise_)),
      walk_(site, grid().cells().corner_site_m, radio_walking(settings)) {
    const bool by_map = settings.radio_map != nullptr;
    const double offset_sigma_db = by_map ? 0 : settings.power_sigma_db;
    Beacon beacon;
    beacon.offset_variance_db2 = static_cast<float>(offset_sigma_db * offset_sigma_db);
    state_.beacons.assign(grid().beacons().size(), beacon);
    readings_.reserve(state_.beacons.size());
}

/// The grid, the same for all, is shared; scratch room is not copied.
void RadioParticles::copy_from(const Estimator& other) noexcept {
    const auto& radio = static_cast<const RadioParticles&>(other);
    walk_.copy_from(radio.walk_);
    state_ = radio.state_;
}

Verdict RadioParticles::update(const Measurement& measurement) noexcept {
    const bool started = state_.missing == Missing::nothing;
    Verdict verdict{Exclusion::unsupported_kind};
    if (const auto* imu = std::get_if<ImuSample>(&measurement.observation)) verdict = {hear(*imu, measurement.time)};
    if (const auto* strength = std::get_if<SignalStrength>(&measurement.observation))
        verdict = hear(*strength, measurement.time);
    if (const auto* foot = std::get_if<FootPoint>(&measurement.observation)) verdict = see(*foot, measurement.time);
    if (started && verdict.reason == Exclusion::none) state_.used.note(measurement.observation, measurement.time);
    return verdict;
}

Exclusion RadioParticles::hear(const ImuSample& sample, Timestamp time) noexcept {
    if (!settings_.use_imu) return Exclusion::disabled;
    walk_.hear(sample, time);
    if (state_.missing != Missing::nothing) return Exclusion::waiting_for_start;
    if (to_s(time - walk_.time()) > longest_radio_outlook_s) walk_.advance(time);
    return Exclusion::none;
}

Verdict RadioParticles::hear(const SignalStrength& strength, Timestamp time) noexcept {
    const std::size_t index = grid().index_of(beacon_of(strength, *site_));
    if (strength.rssi_dbm < radio::weakest_dbm || strength.rssi_dbm > radio::strongest_dbm)
        return {Exclusion::out_of_reach};
    if (index == radio::StrengthGrid::none)
        return strength.other.known() ? hear_peer(strength, time) : Verdict{Exclusion::unknown_beacon};
    if (!state_.scan_begin.has_value()) state_.scan_begin = time;
    if (to_s(time - *state_.scan_begin) >= settings_.scan_s) end_scan(time);

    Beacon& beacon = state_.beacons[index];
    announce(beacon, strength);
    beacon.sum_dbm += strength.rssi_dbm;
    ++beacon.count;
    const float share = new_share(beacon.heard, time, settings_.held_error_time_s);
    beacon.heard = time;
    if (state_.missing != Missing::nothing) return {Exclusion::waiting_for_start};

    walk_.advance(time);
    const Outlook outlook = foresee(index);
    const float innovation_db = strength.rssi_dbm - outlook.mean_dbm, sigma_db = std::sqrt(outlook.variance_db2);
    Verdict verdict = verdict_of(double{innovation_db}, double{sigma_db}, std::sqrt(2 * doubt_limit_));
    verdict.weight = share;
    ++state_.heard;
    state_.odd += std::abs(innovation_db) > odd_sigmas * sigma_db;
    weigh(index, strength.rssi_dbm - beacon.offset_db, share);
    learn_offset(beacon, outlook, innovation_db);
    return verdict;
}

Estimate RadioParticles::predict(Timestamp time) const noexcept {
    Estimate estimate;
    estimate.time = time;
    estimate.reset_count = state_.reset_count;
    estimate.missing = state_.missing;
    estimate.kinds_used = state_.used.lately(time);
    if (state_.missing == Missing::nothing) walk_.write(time, estimate);
    return estimate;
}

std::unique_ptr<Estimator> make_radio_particles(const Site& site, const void* settings) {
    return std::make_unique<RadioParticles>(site, *static_cast<const RadioParticlesSettings*>(settings));
}

} // namespace locus
