#include "fusion/estimators/range_reader.h"

#include <algorithm>
#include <cmath>

namespace locus {
namespace {

/// No device is better than this, whatever it says: a zero sigma would make the filter sure for ever.
constexpr double least_sigma_m = 1e-3;

float noise_m(float stated_m, double surveyed_m, double otherwise_m) {
    const double sigma_m = std::isfinite(stated_m)     ? double{stated_m}
                           : std::isfinite(surveyed_m) ? surveyed_m
                                                       : otherwise_m;
    return static_cast<float>(std::max(sigma_m, least_sigma_m));
}

} // namespace

RangeReader::Reading RangeReader::read(const Measurement& measurement) const noexcept {
    if (const auto* range = std::get_if<Range>(&measurement.observation)) return read(*range);
    if (const auto* difference = std::get_if<RangeDifference>(&measurement.observation)) return read(*difference);
    return {{}, Exclusion::unsupported_kind};
}

RangeReader::Reading RangeReader::read(const Range& range) const noexcept {
    const std::int16_t known = index_of(range.anchor);
    if (known == uwb::Sighting::nobody) return {{}, Exclusion::unknown_source};
    const Exclusion reason = refusal(range.range_m, range.line_of_sight);
    if (reason != Exclusion::none) return {{}, reason};
    const float sigma_m = noise_m(range.sigma_m, anchor(known).sigma_m, settings_.range_sigma_m);
    return {{known, uwb::Sighting::nobody, sigma_m, range.range_m - anchor(known).range_bias_m}};
}

RangeReader::Reading RangeReader::read(const RangeDifference& difference) const noexcept {
    const std::int16_t a = index_of(difference.anchor_a), b = index_of(difference.anchor_b);
    if (a == uwb::Sighting::nobody || b == uwb::Sighting::nobody || a == b) return {{}, Exclusion::unknown_source};
    const Exclusion reason = refusal(difference.difference_m, difference.line_of_sight);
    if (reason != Exclusion::none) return {{}, reason};
    const float sigma_m = noise_m(difference.sigma_m, std::hypot(anchor(a).sigma_m, anchor(b).sigma_m),
                                  settings_.range_difference_sigma_m);
    const double bias_m = anchor(b).range_bias_m - anchor(a).range_bias_m;
    return {{b, a, sigma_m, difference.difference_m - bias_m}};
}

Exclusion RangeReader::refusal(double value_m, LineOfSight line_of_sight) const noexcept {
    if (!std::isfinite(value_m)) return Exclusion::not_finite;
    if (std::abs(value_m) > settings_.max_range_m) return Exclusion::out_of_reach;
    if (line_of_sight == LineOfSight::blocked && !settings_.use_blocked) return Exclusion::reported_blocked;
    return Exclusion::none;
}

std::int16_t RangeReader::index_of(Address anchor) const noexcept {
    const Anchor* found = site_->find_anchor(anchor);
    return found ? static_cast<std::int16_t>(found - site_->anchors.data()) : uwb::Sighting::nobody;
}

} // namespace locus
