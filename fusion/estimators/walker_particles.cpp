#include "fusion/estimators/walker_particles.h"

#include "fusion/estimators/waiting.h"
#include "fusion/geometry/vector.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace locus {
namespace {

/// Blocked paths make a fix that is wrong by about their excess; only what is this many times farther off is elsewhere.
constexpr double elsewhere = 3;
/// The cloud moves at least this often, so that what lies ahead of it is a step at most.
constexpr double longest_outlook_s = 0.5;

uwb::EpochSettings walker_epoch(const WalkerParticlesSettings& s) {
    uwb::EpochSettings epoch;
    epoch.window_s = s.start_window_s;
    epoch.speed_mps = s.speed_sigma_mps;
    epoch.held_range_sigma_m = std::hypot(s.anchor_error_sigma_m, s.height_sigma_m);
    epoch.held_difference_sigma_m = std::numbers::sqrt2 * epoch.held_range_sigma_m;
    epoch.solve.planar = true;
    epoch.solve.height_site_m = s.height_m;
    return epoch;
}

filter::ParticleSettings cloud_settings(const WalkerParticlesSettings& s) {
    filter::ParticleSettings cloud;
    cloud.max_count = s.max_particles;
    cloud.min_count = s.min_particles;
    cloud.seed = static_cast<std::uint64_t>(s.seed);
    return cloud;
}

GaitSettings gait_settings(const WalkerParticlesSettings& s) {
    GaitSettings gait;
    gait.pedestrian.length.person_sigma = s.person_sigma;
    gait.pedestrian.length.step_sigma = s.step_sigma;
    gait.pedestrian.use_compass = s.use_compass;
    gait.course_wander_rad_rts = s.course_wander_rad_rts;
    return gait;
}

WalkingSettings walking_settings(const WalkerParticlesSettings& s) {
    WalkingSettings walking;
    walking.particles = cloud_settings(s);
    walking.gait = gait_settings(s);
    walking.velocity_wander_mps_rts = s.velocity_wander_mps_rts;
    walking.person_sigma = s.person_sigma;
    walking.height_m = s.height_m;
    walking.height_sigma_m = s.height_sigma_m;
    return walking;
}

Eigen::Vector2d middle_of(const Site& site) {
    Eigen::Vector2d sum(0, 0);
    for (const Anchor& anchor : site.anchors) sum += vector(anchor.position_site_m).head<2>();
    return site.anchors.empty() ? sum : Eigen::Vector2d(sum / static_cast<double>(site.anchors.size()));
}

} // namespace

WalkerParticles::WalkerParticles(const Site& site, const WalkerParticlesSettings& settings)
    : site_(&site), settings_(settings), gate_in_sigma_(filter::gate_in_sigma(settings.gate_false_alarm)),
      reader_(site, settings), walk_(site, middle_of(site), walking_settings(settings)),
      state_{filter::AnchorGates(site.anchors.size()),
             std::vector<std::optional<Timestamp>>(site.anchors.size()),
             {},
             uwb::EpochKeeper(site, walker_epoch(settings))} {}

void WalkerParticles::copy_from(const Estimator& other) noexcept {
    const auto& walker = static_cast<const WalkerParticles&>(other);
    walk_.copy_from(walker.walk_);
    state_ = walker.state_;
}

Verdict WalkerParticles::update(const Measurement& measurement) noexcept {
    const bool started = state_.missing == Missing::nothing;
    const Verdict verdict = hear(measurement);
    if (started && verdict.reason == Exclusion::none) state_.used.note(measurement.observation, measurement.time);
    return verdict;
}

Verdict WalkerParticles::hear(const Measurement& measurement) noexcept {
    if (const auto* imu = std::get_if<ImuSample>(&measurement.observation)) return {hear(*imu, measurement.time)};
    if (const auto* peer = std::get_if<PeerRange>(&measurement.observation)) return hear(*peer, measurement.time);
    const RangeReader::Reading reading = reader_.read(measurement);
    return reading.reason == Exclusion::none ? take(reading.sighting, measurement.time) : Verdict{reading.reason};
}

Exclusion WalkerParticles::hear(const ImuSample& sample, Timestamp time) noexcept {
    if (!settings_.use_imu) return Exclusion::disabled;
    walk_.hear(sample, time);
    if (state_.missing != Missing::nothing) return Exclusion::waiting_for_start;
    if (to_s(time - walk_.time()) > longest_outlook_s) walk_.advance(time);
    return Exclusion::none;
}

Verdict WalkerParticles::take(const uwb::Sighting& sighting, Timestamp time) noexcept {
    state_.epoch.keep(sighting, time);
    if (state_.missing != Missing::nothing) return start(time);
    walk_.advance(time);
    const Verdict verdict = weigh(sighting, time);
    start_again_if_lost(time);
    return verdict;
}

Verdict WalkerParticles::start(Timestamp time) noexcept {
    const uwb::EpochKeeper::Answer answer = state_.epoch.solve(time, walk_.place_site_m());
    if (answer.agrees) {
        start_at(answer.fix, time);
        return {};
    }
    const Waiting waiting = waiting_after(answer.fix.reason);
    state_.missing = waiting.missing;
    return {waiting.reason};
}

void WalkerParticles::start_at(const uwb::Fix& fix, Timestamp time) noexcept {
    if (state_.missing == Missing::nothing) ++state_.reset_count;
    const double speed_variance = settings_.speed_sigma_mps * settings_.speed_sigma_mps;
    filter::Particles::Vector4 mean = filter::Particles::Vector4::Zero();
    filter::Particles::Matrix4 covariance = filter::Particles::Matrix4::Identity() * speed_variance;
    if (walk_.by_steps()) { // a wrong place says nothing against the heading
        mean.tail<2>() = cloud().mean().tail<2>();
        covariance.bottomRightCorner<2, 2>() = cloud().covariance().bottomRightCorner<2, 2>();
    }
    mean.head<2>() = walk_.local(fix.position_site_m);
    covariance.topLeftCorner<2, 2>() = Eigen::Matrix3d(fix.covariance_m2.data()).topLeftCorner<2, 2>();
    particles().start(mean, covariance);
    walk_.begin(time);
    state_.gates.begin_anew();
    state_.missing = Missing::nothing;
}

bool WalkerParticles::settle() noexcept { return walk_.settle(); }

/// Most anchors refused may mean a bad site or a cloud in the wrong place: it moves only when the last window agrees on
/// a place and fits there far better than here.
void WalkerParticles::start_again_if_lost(Timestamp time) noexcept {
    if (!state_.gates.most_in_doubt(time, settings_.lost_after_s)) return;
    const uwb::EpochKeeper::Answer answer = state_.epoch.solve(time, walk_.place_site_m());
    const double away_m = (walk_.local(answer.fix.position_site_m) - cloud().mean().head<2>()).norm();
    const bool better = answer.agrees && answer.cost_of_other - answer.fix.cost > gate_in_sigma_ * gate_in_sigma_;
    if (better && away_m > elsewhere * settings_.blocked_excess_m) start_at(answer.fix, time);
}

Estimate WalkerParticles::predict(Timestamp time) const noexcept {
    Estimate estimate;
    estimate.time = time;
    estimate.reset_count = state_.reset_count;
    estimate.missing = state_.missing;
    estimate.kinds_used = state_.used.lately(time);
    if (state_.missing == Missing::nothing) walk_.write(time, estimate);
    return estimate;
}

std::unique_ptr<Estimator> make_walker_particles(const Site& site, const void* settings) {
    return std::make_unique<WalkerParticles>(site, *static_cast<const WalkerParticlesSettings*>(settings));
}

} // namespace locus
