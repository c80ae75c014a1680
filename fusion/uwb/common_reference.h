// Range differences of arbitrary pairs, (7,1) (1,3) (3,4) ..., brought to one reference anchor.
#pragma once

#include "fusion/uwb/epoch.h"

namespace locus::uwb {

struct CommonReference {
    int anchor = 0; ///< index into Epoch::anchors_m
    /// distance(x, anchor i) - distance(x, reference) for every anchor of the epoch, m.
    Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, Epoch::max_anchors, 1> difference_m;
    bool connected = false; ///< every anchor is reached over pairs; else the differences mean nothing
};

/// Weighted least squares over the graph of pairs. Its normal matrix is the graph's Laplacian, which is the inverse of
/// the differences' covariance: that is how the noise carries on.
CommonReference common_reference(const Epoch& epoch) noexcept;

} // namespace locus::uwb
