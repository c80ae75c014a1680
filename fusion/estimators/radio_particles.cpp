#include "fusion/estimators/radio_particles.h"

#include "fusion/estimators/radio_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace locus {
namespace {

/// The cloud moves at least this often, so that what lies ahead of it is a step at most.
constexpr double longest_radio_outlook_s = 0.5;
/// A reading this many standard deviations off happens one time in twenty.
constexpr float odd_sigmas = 2;
/// What readings that fit nothing are spread over, dB: all that a radio hears.
constexpr float outlier_range_db = 80;

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

} // namespace

RadioParticles::RadioParticles(const Site& site, const RadioParticlesSettings& settings)
    : site_(&site), settings_(settings), doubt_limit_(-std::log(settings.gate_false_alarm)),
      grid_(make_radio_grid(site, settings)), posterior_(grid_->cells().count()),
      walk_(site, grid_->cells().corner_site_m, radio_walking(settings)) {
    const bool by_map = settings.radio_map != nullptr;
    const double offset_sigma_db = by_map ? 0 : settings.power_sigma_db;
    Beacon beacon;
    beacon.offset_variance_db2 = static_cast<float>(offset_sigma_db * offset_sigma_db);
    state_.beacons.assign(grid_->beacons().size(), beacon);
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
    const bool heard_at_anchor = site_->find_anchor(strength.receiver) != nullptr;
    const std::size_t index = grid_->index_of(heard_at_anchor ? strength.receiver : strength.transmitter);
    if (index == radio::StrengthGrid::none) return {Exclusion::unknown_beacon};
    if (strength.rssi_dbm < radio::weakest_dbm || strength.rssi_dbm > radio::strongest_dbm)
        return {Exclusion::out_of_reach};
    if (!state_.scan_begin.has_value()) state_.scan_begin = time;
    if (to_s(time - *state_.scan_begin) >= settings_.scan_s) end_scan(time);

    Beacon& beacon = state_.beacons[index];
    announce(beacon, strength);
    beacon.sum_dbm += strength.rssi_dbm;
    ++beacon.count;
    const float share = share_of(beacon.heard, time);
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

/// A beacon that says what it sends is known by that; two decibels are left, what beacons of one kind differ by.
void RadioParticles::announce(Beacon& beacon, const SignalStrength& strength) const noexcept {
    constexpr float announced_variance_db2 = 4;
    if (!std::isfinite(strength.tx_power_dbm) || beacon.offset_variance_db2 <= announced_variance_db2) return;
    beacon.offset_db = strength.tx_power_dbm - static_cast<float>(settings_.power_1m_dbm);
    beacon.offset_variance_db2 = announced_variance_db2;
}

/// A beacon heard faster than its deviation changes says the same again.
float RadioParticles::share_of(const std::optional<Timestamp>& last, Timestamp time) const noexcept {
    if (!last.has_value() || settings_.held_error_time_s <= 0) return 1;
    return static_cast<float>(std::min(1.0, to_s(time - *last) / settings_.held_error_time_s));
}

RadioParticles::Outlook RadioParticles::foresee(std::size_t beacon) const noexcept {
    const auto step = static_cast<float>(grid_->cells().cell_m);
    const Eigen::Vector2f place = walk_.place_site_m().head<2>().cast<float>();
    const radio::Expected here = grid_->at(beacon, place.x(), place.y());
    const auto at = [&](float dx, float dy) { return grid_->at(beacon, place.x() + dx, place.y() + dy).mean_dbm; };
    Outlook outlook;
    outlook.mean_dbm = here.mean_dbm + state_.beacons[beacon].offset_db;
    outlook.gradient_dbpm =
        Eigen::Vector2f((at(step, 0) - at(-step, 0)) / (2 * step), (at(0, step) - at(0, -step)) / (2 * step))
            .cast<double>();
    const double spread_db2 =
        outlook.gradient_dbpm.dot(cloud().covariance().topLeftCorner<2, 2>() * outlook.gradient_dbpm);
    outlook.variance_db2 =
        here.variance_db2 + state_.beacons[beacon].offset_variance_db2 + static_cast<float>(std::max(0.0, spread_db2));
    return outlook;
}

/// A Kalman filter of one state for the power that a path-loss model does not know.
void RadioParticles::learn_offset(Beacon& beacon, const Outlook& outlook, float innovation_db) noexcept {
    if (beacon.offset_variance_db2 <= 0) return;
    const float gain = beacon.offset_variance_db2 / outlook.variance_db2;
    beacon.offset_db +=
        gain * std::clamp(innovation_db, -3 * std::sqrt(outlook.variance_db2), 3 * std::sqrt(outlook.variance_db2));
    beacon.offset_variance_db2 *= 1 - gain;
}

/// A bell with a floor under it, for what fits nothing; `share` of it, where part was said before.
void RadioParticles::weigh(std::size_t beacon, float rssi_dbm, float share) noexcept {
    const auto outliers = static_cast<float>(settings_.outlier_share);
    const float floor = outliers / outlier_range_db;
    const float peak = (1 - outliers) / std::sqrt(2 * std::numbers::pi_v<float>);
    const Eigen::Vector2f origin = walk_.origin_site_m().cast<float>();
    const float offset_db2 = state_.beacons[beacon].offset_variance_db2;
    walk_.particles().weigh_places([&](float x, float y) {
        const radio::Expected expected = grid_->at(beacon, x + origin.x(), y + origin.y());
        const float variance = expected.variance_db2 + offset_db2, off = rssi_dbm - expected.mean_dbm;
        const float bell = peak / std::sqrt(variance) * filter::exp_of_negative(-0.5f * off * off / variance);
        return share * std::log(bell + floor);
    });
    walk_.settle();
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
