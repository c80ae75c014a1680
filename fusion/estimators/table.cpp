// The estimators that a configuration can name.
#include "fusion/estimators/range_ekf.h"
#include "fusion/estimators/walker_particles.h"

#include <algorithm>
#include <array>

namespace locus {
namespace {
constexpr std::array rows{range_ekf_row, walker_particles_row};
}

std::span<const EstimatorRow> estimator_table() { return rows; }

const EstimatorRow* find_estimator(std::string_view name) {
    const auto table = estimator_table();
    const auto row = std::find_if(table.begin(), table.end(), [&](const EstimatorRow& r) { return r.name == name; });
    return row == table.end() ? nullptr : &*row;
}

} // namespace locus
