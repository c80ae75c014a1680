// The estimators that a configuration can name.
#include "fusion/estimators/chan_taylor.h"
#include "fusion/estimators/federated.h"
#include "fusion/estimators/gnss_ins.h"
#include "fusion/estimators/inertial_ekf.h"
#include "fusion/estimators/kalman.h"
#include "fusion/estimators/radio_particles.h"
#include "fusion/estimators/range_ekf.h"
#include "fusion/estimators/visual_scale.h"
#include "fusion/estimators/walker_particles.h"

#include <algorithm>
#include <array>

namespace locus {
namespace {
constexpr std::array rows{inertial_ekf_row,     gnss_ins_row,        range_ekf_row,    federated_row,
                          walker_particles_row, radio_particles_row, visual_scale_row, chan_taylor_row,
                          kalman_row,           coloured_kalman_row, pca_kalman_row};
}

std::span<const EstimatorRow> estimator_table() { return rows; }

const EstimatorRow* find_estimator(std::string_view name) {
    const auto table = estimator_table();
    const auto row = std::find_if(table.begin(), table.end(), [&](const EstimatorRow& r) { return r.name == name; });
    return row == table.end() ? nullptr : &*row;
}

} // namespace locus
