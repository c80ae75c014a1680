#include "fusion/vision/survey/floor_survey.h"

#include "fusion/vision/survey/floor_start.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace locus::vision::survey {
namespace {

std::vector<TimedPair> standing(std::span<const FloorPair> pairs) {
    std::vector<TimedPair> out;
    for (const FloorPair& pair : pairs) out.push_back({pair, Eigen::Vector2d::Zero()});
    return out;
}

bool spans_area(std::span<const FloorPair> pairs) {
    std::vector<Eigen::Vector2d> places_m;
    for (const FloorPair& pair : pairs) places_m.push_back(pair.site_m);
    const Eigen::Vector2d extent = extent_m(places_m);
    return extent.y() > least_width_share * extent.x();
}

int redundancy_of(const FloorFit& fit) {
    return 2 * static_cast<int>(fit.residuals.size()) - view_parameters(fit.view);
}

/// Of a pair that the fit has not seen.
double prediction_test(const FloorFit& fit, const FloorPair& pair) {
    const Residual residual = residual_of(fit.view, pair);
    const auto sight = sight_of(fit.view, pair.site_m, fit.centre_m);
    if (!residual.is_seen || !sight) return std::numeric_limits<double>::infinity();
    Eigen::Matrix2d covariance_px2 = sight->by_view * fit.covariance * sight->by_view.transpose() +
                                     pair.sigma_m * pair.sigma_m * sight->by_floor * sight->by_floor.transpose();
    covariance_px2.diagonal().array() += pair.sigma_px * pair.sigma_px;
    return residual.error_px.dot(covariance_px2.inverse() * residual.error_px);
}

/// By how much residuals are larger than they should be.
double widening_of(const FloorFit& fit) {
    double cost = 0;
    for (const Residual& residual : fit.residuals) cost += residual.test;
    const int redundancy = redundancy_of(fit);
    return redundancy > 0 ? std::max(1., std::sqrt(cost / redundancy)) : 1;
}

/// Over the rest's own misfit (externally studentized: Belsley, Kuh and Welsch 1980, eq. 2.26): with a wrong point
/// among them the rest fits badly, and says less of a good one.
double test_against_rest(std::span<const FloorPair> pairs, std::size_t one, const std::optional<Lens>& lens) {
    std::vector<FloorPair> rest(pairs.begin(), pairs.end());
    rest.erase(rest.begin() + static_cast<std::ptrdiff_t>(one));
    const auto start = start_view(rest, lens);
    if (!start || !spans_area(rest)) return std::numeric_limits<double>::quiet_NaN();
    const FloorFit fit = fit_view(*start, standing(rest));
    if (!fit.is_told) return std::numeric_limits<double>::quiet_NaN();
    const double widening = widening_of(fit);
    return prediction_test(fit, pairs[one]) / (widening * widening);
}

/// The index of the largest, and whether it is twice as large as the next. NaN counts as nothing.
void tell_worst(FloorSurvey& survey) {
    const bool can_ask = std::ranges::any_of(survey.against_rest, [](double test) { return std::isfinite(test); });
    double largest = -1, next = -1;
    for (std::size_t i = 0; i < survey.against_rest.size(); ++i) {
        const double test = can_ask ? survey.against_rest[i] : survey.fit.residuals[i].test;
        if (test > largest) {
            next = std::exchange(largest, test);
            survey.worst = i;
        } else
            next = std::max(next, std::isnan(test) ? next : test);
    }
    survey.is_worst_told = can_ask && largest > worst_test && largest > 2 * next;
}

} // namespace

Eigen::Vector2d extent_m(std::span<const Eigen::Vector2d> places_m) {
    if (places_m.empty()) return Eigen::Vector2d::Zero();
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const auto& place : places_m) mean += place / static_cast<double>(places_m.size());
    Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
    for (const auto& place : places_m)
        spread += (place - mean) * (place - mean).transpose() / static_cast<double>(places_m.size());
    const Eigen::Vector2d squares = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(spread).eigenvalues();
    return squares.cwiseMax(0).cwiseSqrt().reverse();
}

FloorSurvey survey_floor(std::span<const FloorPair> pairs, const std::optional<Lens>& lens) {
    FloorSurvey survey;
    const auto refused = [&](FloorTrouble trouble) {
        survey.trouble = trouble;
        return survey;
    };
    if (pairs.size() < least_pairs) return refused(FloorTrouble::too_few);
    if (!spans_area(pairs)) return refused(FloorTrouble::in_one_line);
    const auto start = start_view(pairs, lens);
    if (!start) return refused(FloorTrouble::not_told);
    survey.fit = fit_view(*start, standing(pairs));
    if (!survey.fit.is_told) return refused(FloorTrouble::not_told);
    survey.redundancy = redundancy_of(survey.fit);
    survey.widening = widening_of(survey.fit);
    survey.fit.covariance *= survey.widening * survey.widening;
    for (std::size_t i = 0; i < pairs.size(); ++i) survey.against_rest.push_back(test_against_rest(pairs, i, lens));
    tell_worst(survey);
    if (!is_seen_from_above(survey.fit.view)) return refused(FloorTrouble::mirrored);
    return survey;
}

} // namespace locus::vision::survey
