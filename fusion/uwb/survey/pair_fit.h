// How well a network determines its unknowns, and what that leaves to control each pair.
#pragma once

#include "fusion/uwb/survey/network_rows.h"

#include <Eigen/Core>

namespace locus::uwb::survey {

struct Spread {
    Eigen::MatrixXd covariance; ///< of what is determined
    Eigen::VectorXd sigma;      ///< infinite of what is not
};

Spread spread_of(const Eigen::MatrixXd& information);

PairFit fit_of(const PairRange& pair, const Unknowns& unknowns, const Positions& at_m,
               const Eigen::MatrixXd& covariance, double scale = half_weight_sigma);

} // namespace locus::uwb::survey
