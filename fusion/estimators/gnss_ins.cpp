#include "fusion/estimators/gnss_ins.h"

#include "fusion/geometry/vector.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace locus {
namespace {

constexpr double vehicle_kind_memory_s = 1;
/// Fixes are left aside for so long after a satellite's range was heard, where the coupling is automatic.
constexpr double satellites_memory_s = 2;
/// Before any fix the clock is unknown: satellites then set it.
constexpr double unknown_clock_m = 1000, unknown_drift_mps = 1000;
/// Observations over which the share of refused ones is taken, and from which share on the filter may be lost. Fixes
/// under a bridge are wrong for a minute and dead reckoning is not, so that it takes 350 of them in a row.
constexpr double fix_memory = 150;

bool tells_velocity(const Vec3f& v) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

template <std::size_t... i>
std::array<filter::RobustGain, sizeof...(i)> gains(double scale, std::index_sequence<i...> /*count*/) {
    return {((void)i, filter::RobustGain(scale))...};
}

} // namespace

GnssIns::GnssIns(const Site& site, const GnssInsSettings& settings)
    : site_(&site), observations_(std::make_shared<const GnssInsObservations>(site, settings)),
      gate_in_sigma_(filter::gate_in_sigma(settings.gate_false_alarm)),
      consistency_quantile_(filter::gate_in_sigma(std::min(1.0, 2 * settings.gate_false_alarm))),
      track_(observations_->motion_model()), robust_(gains(settings.robust_scale, std::make_index_sequence<aids>())) {}

// NOLINTBEGIN(bugprone-exception-escape): all alternatives are trivial, so the variant never loses its value
Verdict GnssIns::update(const Measurement& measurement) noexcept {
    if (!site_->origin) return {Exclusion::site_without_origin};
    const Verdict verdict =
        std::visit([&](const auto& sample) { return take(sample, measurement.time); }, measurement.observation);
    if (verdict.reason == Exclusion::none) kind_used_[measurement.observation.index()] = measurement.time;
    return verdict;
}
// NOLINTEND(bugprone-exception-escape)

void GnssIns::move_to(Timestamp time) noexcept {
    if (started_ && time > time_) {
        finish_epoch();
        track_.predict(to_s(time - time_));
    }
    time_ = time;
}

// ---- start

Verdict GnssIns::start(const GnssInsStart& start, Timestamp time) noexcept {
    if (started_) ++reset_count_;
    carriers_.forget();
    track_.start(start);
    time_ = used_time_ = time;
    refused_share_ = 0;
    started_ = true;
    return {};
}

Verdict GnssIns::start_at(const GnssFix& fix, Timestamp time) noexcept {
    const Geodetic place{fix.latitude_deg, fix.longitude_deg, fix.height_ellipsoid_m};
    const Eigen::Matrix3d enu = enu_to_ecef(place);
    const auto sigma = [](float told, double otherwise) { return told > 0 ? double{told} : otherwise; };
    const double error = settings().fix_error_sigma_m;
    const double level = std::hypot(sigma(fix.sigma_horizontal_m, settings().fix_sigma_m), error);
    const double up = std::hypot(sigma(fix.sigma_vertical_m, settings().fix_sigma_m), error);
    const bool moves = tells_velocity(fix.velocity_enu_mps);
    const double speed = moves ? sigma(fix.sigma_velocity_mps, settings().fix_speed_sigma_mps) : 10;
    GnssInsStart start;
    start.position_ecef_m = ecef_m(place);
    if (moves)
        start.velocity_ecef_mps =
            enu * Eigen::Vector3d(double{fix.velocity_enu_mps[0]}, double{fix.velocity_enu_mps[1]},
                                  double{fix.velocity_enu_mps[2]});
    start.position_covariance_m2 =
        enu * Eigen::Vector3d(level * level, level * level, up * up).asDiagonal() * enu.transpose();
    start.velocity_covariance_m2ps2 = speed * speed * Eigen::Matrix3d::Identity();
    start.clock_offset_sigma_m = unknown_clock_m;
    start.clock_drift_sigma_mps = unknown_drift_mps;
    return this->start(start, time);
}

void GnssIns::note(const Verdict& verdict, Timestamp time, double memory) noexcept {
    const bool refused = verdict.reason != Exclusion::none;
    refused_share_ += ((refused ? 1.0 : 0.0) - refused_share_) / memory;
    if (!refused) used_time_ = time;
}

// ---- fixes

Verdict GnssIns::take(const GnssFix& fix, Timestamp time) noexcept {
    const bool satellites = to_s(time - satellites_heard_) < satellites_memory_s;
    const bool wanted = settings().coupling == "auto" ? !satellites : settings().coupling != "tight";
    if (!wanted) return {Exclusion::disabled};
    if (fix.fix_type == gnss_fix_type::none || fix.fix_type == gnss_fix_type::dead_reckoning)
        return {Exclusion::geometry_too_few};
    if (!started_) return start_at(fix, time);
    move_to(time);
    if (height_is_off(fix)) return {Exclusion::innovation_too_large};
    const Verdict verdict = take_fix(fix);
    note(verdict, time, fix_memory);
    if (refused_share_ > lost_share) start_at(fix, time);
    return verdict;
}

/// The worst verdict of the three axes; a fix is taken or left as a whole by each axis' own gate.
Verdict GnssIns::take_fix(const GnssFix& fix) noexcept {
    Verdict worst;
    worst.test_ratio = -1;
    const int axes = fix.fix_type == gnss_fix_type::flat ? 2 : 3;
    for (int axis = 0; axis < axes; ++axis) {
        const auto at = static_cast<std::size_t>(axis);
        const Verdict verdict = weigh(Aid::fix, observations_->fix_position(track_, fix, axis),
                                      gates_[static_cast<std::size_t>(Aid::fix)][at]);
        if (verdict.test_ratio > worst.test_ratio) worst = verdict;
        if (tells_velocity(fix.velocity_enu_mps))
            weigh(Aid::fix_velocity, observations_->fix_velocity(track_, fix, axis),
                  gates_[static_cast<std::size_t>(Aid::fix_velocity)][at]);
    }
    return worst;
}

// ---- the update

/// Without an inertial sensor a receiver's velocity that comes as a surprise is a vehicle that brakes: to weigh it less
/// would be to run on.
bool GnssIns::tells_of_a_manoeuvre(Aid aid) const noexcept { return aid == Aid::fix_velocity && !track_.is_inertial(); }

Verdict GnssIns::weigh(Aid aid, const GnssInsScalar& scalar, filter::Gate& gate) noexcept {
    const auto at = static_cast<std::size_t>(aid);
    const bool learns = settings().adaptive_noise && aid <= Aid::fix_velocity;
    const double variance = learns ? scalar.variance * noise_[at].factor() : scalar.variance;
    const auto prediction = filter::predict_scalar(track_.covariance, scalar.jacobian);
    const double sigma = std::sqrt(prediction.state_variance + variance);
    const double in_sigma = scalar.innovation / sigma;

    Verdict verdict;
    verdict.innovation = static_cast<float>(scalar.innovation);
    verdict.innovation_sigma = static_cast<float>(sigma);
    verdict.test_ratio = static_cast<float>(std::abs(in_sigma) / gate_in_sigma_);
    if (!gate.passes(in_sigma, gate_in_sigma_, static_cast<std::uint32_t>(settings().gate_patience))) {
        verdict.reason = Exclusion::innovation_too_large;
        verdict.weight = 0;
        return verdict;
    }
    if (learns) noise_[at].learn(scalar.innovation, prediction.state_variance, scalar.variance);
    const filter::Share share = tells_of_a_manoeuvre(aid) ? filter::Share{} : robust_[at].weigh(in_sigma);
    verdict.weight = static_cast<float>(share.step);
    track_.correct(prediction, scalar.innovation, variance, share);
    return verdict;
}

// ---- pose

/// With the carriers that wait for the end of their epoch, which is over by then.
Estimate GnssIns::predict(Timestamp time) const noexcept {
    if (time <= time_ || !carriers_.is_waiting()) return prospect(time);
    GnssIns then = *this;
    then.move_to(time);
    return then.prospect(time);
}

Estimate GnssIns::prospect(Timestamp time) const noexcept {
    Estimate estimate;
    estimate.time = time;
    estimate.reset_count = reset_count_;
    estimate.missing = started_ ? Missing::nothing : Missing::measurements;
    if (!site_->origin) estimate.missing = Missing::site_origin;
    for (std::size_t kind = 0; kind < kind_used_.size(); ++kind)
        if (kind_used_[kind] != Timestamp{} && to_s(time - kind_used_[kind]) <= vehicle_kind_memory_s)
            estimate.kinds_used |= 1u << kind;
    if (!started_) return estimate;
    if (to_s(time - used_time_) > settings().dead_reckoning_s) estimate.missing = Missing::fresh_measurements;

    GnssInsTrack track = track_;
    track.predict(std::max(0.0, to_s(time - time_)));
    report(track, estimate);
    return estimate;
}

/// Of the antenna, in the site's frame.
void GnssIns::report(const GnssInsTrack& track, Estimate& estimate) const noexcept {
    const Eigen::Matrix3d to_site = observations_->earth().to_ecef().transpose();
    const Eigen::Vector3d antenna = vector(settings().gnss_antenna_body_m);
    const Eigen::Vector3d position = observations_->earth().site_m(track.point_ecef_m(antenna));
    const Eigen::Vector3d velocity = to_site * track.point_velocity_ecef_mps(antenna);
    Eigen::Matrix<double, 6, GnssInsTrack::max_size> rows = Eigen::Matrix<double, 6, GnssInsTrack::max_size>::Zero();
    for (int axis = 0; axis < 3; ++axis) {
        estimate.position_site_m[static_cast<std::size_t>(axis)] = position(axis);
        estimate.velocity_site_mps[static_cast<std::size_t>(axis)] = velocity(axis);
        GnssInsTrack::Vector by_position = GnssInsTrack::Vector::Zero(track.size()), by_velocity = by_position;
        track.spread_position(to_site.row(axis), antenna, by_position);
        track.spread_velocity(to_site.row(axis), antenna, by_velocity);
        rows.row(axis).head(track.size()) = by_position;
        rows.row(axis + 3).head(track.size()) = by_velocity;
    }
    const auto core = rows.leftCols<gnss_ins_core>();
    Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(estimate.covariance.data()) =
        core * track.covariance.topLeftCorner<gnss_ins_core, gnss_ins_core>() * core.transpose();
    if (track.is_inertial()) {
        const Eigen::Quaterniond q = Eigen::Quaterniond(to_site) * track.body_to_ecef();
        estimate.orientation_xyzw = {q.x(), q.y(), q.z(), q.w()};
    }
}

std::unique_ptr<Estimator> make_gnss_ins(const Site& site, const void* settings) {
    return std::make_unique<GnssIns>(site, *static_cast<const GnssInsSettings*>(settings));
}

} // namespace locus
