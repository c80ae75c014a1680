#include "fusion/uwb/survey/network_rows.h"

#include "fusion/filter/robust_gain.h"
#include "fusion/uwb/range_model.h"

#include <cmath>

namespace locus::uwb::survey {
namespace {

void add(Normal& normal, const PairRow& row, double weight) {
    for (std::size_t i = 0; i < 6; ++i) {
        if (row.unknown[i] < 0) continue;
        const auto slope_i = row.slope(static_cast<Eigen::Index>(i));
        normal.projection(row.unknown[i]) += weight * slope_i * row.residual;
        for (std::size_t j = 0; j < 6; ++j)
            if (row.unknown[j] >= 0)
                normal.information(row.unknown[i], row.unknown[j]) +=
                    weight * slope_i * row.slope(static_cast<Eigen::Index>(j));
    }
}

double robust_cost(double residual, double scale) {
    const double u = residual / scale;
    return scale * scale * std::log1p(u * u);
}

} // namespace

PairRow row_of(const PairRange& pair, const Unknowns& unknowns, const Positions& at_m) {
    const auto a = static_cast<Eigen::Index>(pair.a), b = static_cast<Eigen::Index>(pair.b);
    const Sight sight = sight_of(at_m.row(a).transpose(), at_m.row(b).transpose());
    PairRow row;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto column = static_cast<Eigen::Index>(axis);
        row.unknown[axis] = unknowns.number(a, column);
        row.unknown[axis + 3] = unknowns.number(b, column);
    }
    row.slope << sight.gradient, -sight.gradient;
    row.slope /= pair.sigma_m;
    row.residual = (pair.range_m - sight.range_m) / pair.sigma_m;
    return row;
}

bool usable(const PairRange& pair, Eigen::Index stations) {
    const auto count = static_cast<std::size_t>(stations);
    return pair.a != pair.b && pair.a < count && pair.b < count && pair.sigma_m > 0 && std::isfinite(pair.range_m);
}

Normal linearise(const std::vector<PairRange>& pairs, const Unknowns& unknowns, const Positions& at_m, double scale) {
    Normal normal{Eigen::MatrixXd::Zero(unknowns.count, unknowns.count), Eigen::VectorXd::Zero(unknowns.count), 0};
    for (const PairRange& pair : pairs) {
        if (!usable(pair, at_m.rows())) continue;
        const PairRow row = row_of(pair, unknowns, at_m);
        add(normal, row, filter::cauchy_weight(row.residual, scale));
        normal.cost += robust_cost(row.residual, scale);
    }
    return normal;
}

double cost_at(const std::vector<PairRange>& pairs, const Positions& at_m, double scale) {
    double cost = 0;
    for (const PairRange& pair : pairs) {
        if (!usable(pair, at_m.rows())) continue;
        const auto a = static_cast<Eigen::Index>(pair.a), b = static_cast<Eigen::Index>(pair.b);
        cost += robust_cost((pair.range_m - (at_m.row(a) - at_m.row(b)).norm()) / pair.sigma_m, scale);
    }
    return cost;
}

} // namespace locus::uwb::survey
