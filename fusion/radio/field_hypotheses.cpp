#include "fusion/radio/field_hypotheses.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace locus::radio {
namespace {

constexpr Eigen::Index most_search_points = 64, most_search_beacons = 48;
/// What weighs less in a mixture is not worth its time.
constexpr double least_hypothesis = 0.01;

/// Of single strengths about their beacon's mean.
double spread_db(const FieldData& data) {
    const Eigen::MatrixXd off = data.strengths_dbm.rowwise() - data.strengths_dbm.colwise().mean();
    return std::max(1.0, std::sqrt(off.squaredNorm() / static_cast<double>(off.size())));
}

/// From well below the spacing of points to the whole map; deviations from hardly any to more than all there is.
std::vector<FieldHypothesis> hypotheses(const FieldData& data, double spacing_m) {
    constexpr std::array lengths{0.6, 1.2, 2.5, 5.0, 10.0, 20.0};
    constexpr std::array shared{0.2, 0.35, 0.6, 1.0, 1.6};
    constexpr std::array own{0.15, 0.25, 0.4, 0.6, 0.9, 1.3};
    const double all_db = spread_db(data);
    std::vector<FieldHypothesis> list;
    for (const double length : lengths)
        for (const double s : shared)
            for (const double o : own) list.push_back({length * spacing_m, s * all_db, o * all_db});
    return list;
}

} // namespace

std::vector<WeightedHypothesis> likely(const FieldData& data, double spacing_m) {
    const FieldData search = thinned(data, most_search_points, most_search_beacons);
    std::vector<WeightedHypothesis> all;
    for (const FieldHypothesis& each : hypotheses(search, spacing_m))
        all.push_back({each, FieldEvidence(search, each).total()});
    const double best = std::ranges::max_element(all, {}, &WeightedHypothesis::weight)->weight;
    const bool is_whole = search.points_m.rows() == data.points_m.rows();
    const double least = is_whole ? std::log(least_hypothesis) : 0;
    std::erase_if(all, [&](const WeightedHypothesis& each) { return each.weight - best < least; });
    double sum = 0;
    for (WeightedHypothesis& each : all) sum += each.weight = std::exp(each.weight - best);
    for (WeightedHypothesis& each : all) each.weight /= sum;
    return all;
}

} // namespace locus::radio
