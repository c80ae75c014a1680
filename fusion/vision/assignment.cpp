#include "fusion/vision/assignment.h"

#include <dlib/optimization/max_cost_assignment.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace locus::vision {
namespace {

constexpr double steps_of_limit = 1e6;

std::int64_t gain_of(double cost, double limit) {
    if (!(cost < limit)) return 0;
    return 1 + std::llround((limit - std::max(cost, -limit)) / limit * steps_of_limit);
}

} // namespace

Pairing assign(const Costs& costs, double limit) {
    Pairing pairs;
    if (costs.rows() == 0 || costs.columns() == 0) return pairs;
    const auto side = static_cast<long>(std::max(costs.rows(), costs.columns()));
    dlib::matrix<std::int64_t> gains = dlib::zeros_matrix<std::int64_t>(side, side); // dlib wants a square
    for (std::size_t row = 0; row < costs.rows(); ++row)
        for (std::size_t column = 0; column < costs.columns(); ++column)
            gains(static_cast<long>(row), static_cast<long>(column)) = gain_of(costs.at(row, column), limit);
    const std::vector<long> columns = dlib::max_cost_assignment(gains);
    for (std::size_t row = 0; row < costs.rows(); ++row) {
        const long column = columns[row];
        if (gains(static_cast<long>(row), column) > 0) pairs.emplace_back(row, static_cast<std::size_t>(column));
    }
    return pairs;
}

} // namespace locus::vision
