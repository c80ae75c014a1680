#include "fusion/estimators/visual_scale.h"

#include "fusion/geometry/vector.h"
#include "fusion/vision/scale/similarity_start.h"

#include <algorithm>
#include <cmath>

namespace locus {
namespace {

/// No two places for the start nearer in time than this, be the odometry ever so fast: the errors of two would be one.
constexpr double least_gap_s = 0.3;
/// Ranges this far apart are no longer one: at a few metres from an anchor a path bends against it by centimetres.
constexpr double together_m = 0.5;
/// Height of somebody who is said to keep to a plane: what a step lifts.
constexpr float plane_sigma_m = 0.05f;

vision::RangePathSettings path_settings(const VisualScaleSettings& s) {
    return {s.anchor_error_sigma_m, s.anchor_error_time_s, s.steady_acceleration_sigma_mps2, s.longest_gap_s};
}

vision::SimilarityFitSettings fit_settings(const VisualScaleSettings& s) {
    return {s.drift_m_rtm, s.time_offset_sigma_s, s.common_range_error_sigma_m};
}

/// The alignment's error is another state when its sigma has changed by this much: it was fitted to much more by then,
/// or the target is elsewhere.
constexpr double renewed_ratio = 0.7;
/// A path drifts by its way, a held error with time: they meet at a walker's pace.
constexpr double walking_mps = 1;
constexpr double longest_held_s = 1e6;
/// The alignment was fitted to the very ranges that the filter hears. How far their errors are the same nobody knows,
/// so its variance counts as covariance intersection at equal shares has it.
constexpr double counted_again = 2;

} // namespace

VisualScale::VisualScale(const Site& site, const VisualScaleSettings& settings)
    : settings_(settings), heard_(site, settings), fused_(site, settings), reader_(site, settings), site_(&site),
      path_(path_settings(settings)) {}

Verdict VisualScale::update(const Measurement& measurement) noexcept {
    if (const auto* odometry = std::get_if<VisualOdometry>(&measurement.observation))
        return see(*odometry, measurement);
    const RangeReader::Reading reading = reader_.read(measurement);
    if (reading.reason == Exclusion::none) path_.hear(reading.sighting, measurement.time);
    heard_.update(measurement);
    return fused_.update(measurement);
}

Verdict VisualScale::see(const VisualOdometry& odometry, const Measurement& measurement) noexcept {
    if (!has_begun_ || odometry.segment != segment_ || odometry.camera != camera_) begin_segment(odometry);
    if (settings_.planar)
        path_.hear({uwb::Sighting::nobody, uwb::Sighting::nobody, plane_sigma_m, settings_.height_m}, measurement.time);
    const double together_odometry = fit_ ? together_m / fit_->similarity.scale() : 0;
    const bool grown = path_.pass(vector(odometry.position_odometry), measurement.time, rows_, together_odometry);
    keep_place(measurement.time);
    if (grown) align();
    const vision::SimilarityFit* fit = aligned();
    if (fit == nullptr) return {Exclusion::waiting_for_start};
    const Verdict verdict = fused_.see(aligned_place(*fit), measurement);
    doubt(verdict);
    return verdict;
}

void VisualScale::begin_segment(const VisualOdometry& odometry) noexcept {
    has_begun_ = true;
    camera_ = odometry.camera;
    segment_ = odometry.segment;
    align_anew();
}

void VisualScale::align_anew() noexcept {
    path_.clear();
    rows_.clear();
    places_.clear();
    fit_.reset();
    kept_.reset();
    held_sigma_m_.setZero();
    refused_in_a_row_ = 0;
}

void VisualScale::keep_place(Timestamp time) noexcept {
    if (aligned() != nullptr || (kept_.has_value() && to_s(time - kept_.value()) < least_gap_s)) return;
    const Estimate heard = heard_.predict(time);
    if (heard.missing != Missing::nothing) return;
    const double variance_m2 = heard.covariance[0] + heard.covariance[7] + heard.covariance[14];
    places_.add({path_.here().position_odometry, vector(heard.position_site_m), 1 / std::max(variance_m2, 1e-6)});
    kept_ = time;
}

/// From the fit before, once it is sure; until then each from nothing.
void VisualScale::align() noexcept {
    if (const vision::SimilarityFit* before = aligned()) {
        fit_ = vision::fit_similarity(*before, rows_.all(), *site_, fit_settings(settings_));
        return;
    }
    const auto start = vision::start_of_similarity(places_.all());
    fit_.reset();
    if (!start.has_value()) return;
    vision::SimilarityFit rough;
    rough.similarity = start.value();
    fit_ = vision::fit_similarity(rough, rows_.all(), *site_, fit_settings(settings_));
}

/// The fit, once it may go into the pose.
const vision::SimilarityFit* VisualScale::aligned() const noexcept {
    if (!fit_) return nullptr;
    const vision::SimilarityFit& fit = *fit_;
    return fit.relative_scale_sigma() < settings_.aligned_below ? &fit : nullptr;
}

/// The held error grows at first as the path drifts: a wandering error does so by 2 sigma^2 / time.
AlignedPlace VisualScale::aligned_place(const vision::SimilarityFit& fit) noexcept {
    const vision::RangeRow& here = path_.here();
    const double drift_m2_s = settings_.drift_m_rtm * settings_.drift_m_rtm * walking_mps;
    const Eigen::Matrix3d covariance_m2 = fit.place_covariance_m2(here.position_odometry, here.velocity_odometry_per_s);
    renew_error((counted_again * covariance_m2.diagonal().array() + drift_m2_s).sqrt());
    AlignedPlace place;
    place.position_site_m = fit.similarity.place_site_m(here.position_odometry, here.velocity_odometry_per_s);
    place.held_sigma_m = held_sigma_m_;
    place.held_time_s = (2 * held_sigma_m_.array().square() / std::max(drift_m2_s, 1e-9)).min(longest_held_s);
    place.noise_sigma_m = settings_.key_frame_sigma_m;
    place.alignment = alignment_;
    return place;
}

void VisualScale::renew_error(const Eigen::Vector3d& sigma_m) noexcept {
    const Eigen::Array3d ratio = sigma_m.array() / held_sigma_m_.array();
    if ((ratio > renewed_ratio).all() && (ratio < 1 / renewed_ratio).all()) return;
    held_sigma_m_ = sigma_m;
    ++alignment_;
}

/// A SLAM that went astray without a word of it is a new segment.
void VisualScale::doubt(const Verdict& verdict) noexcept {
    refused_in_a_row_ = verdict.reason == Exclusion::innovation_too_large ? refused_in_a_row_ + 1 : 0;
    if (refused_in_a_row_ > settings_.gate_patience) align_anew();
}

Estimate VisualScale::predict(Timestamp time) const noexcept {
    Estimate estimate = fused_.predict(time);
    if (!fit_) return estimate;
    const double relative_sigma = fit_->relative_scale_sigma();
    estimate.odometry_scale.relative_sigma = static_cast<float>(relative_sigma);
    if (relative_sigma < settings_.known_below) estimate.odometry_scale.metres_per_unit = fit_->similarity.scale();
    return estimate;
}

std::unique_ptr<Estimator> make_visual_scale(const Site& site, const void* settings) {
    return std::make_unique<VisualScale>(site, *static_cast<const VisualScaleSettings*>(settings));
}

} // namespace locus
