// What the solvers see of one epoch: the anchors without repetition, moved to their centroid so that large site
// coordinates cost no digits, and one row per observation. A range is a difference against an anchor of distance zero.
#pragma once

#include "fusion/uwb/solve.h"

#include <Eigen/Core>
#include <boost/container/static_vector.hpp>

namespace locus::uwb {

/// distance(x, anchor b) - distance(x, anchor a) = value_m. Indices into Epoch::anchors_m.
struct Row {
    int a = 0;
    int b = 0;
    double value_m = 0;
    double inverse_sigma = 0; ///< 1/m
};

struct Epoch {
    static constexpr int no_anchor = 0; ///< stands for "a" of a range: distance and gradient are zero
    static constexpr int max_anchors = 2 * static_cast<int>(max_observations) + 1;

    /// 3 x anchors, relative to `origin_site_m`; column 0 is no_anchor.
    Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, max_anchors> anchors_m;
    boost::container::static_vector<Row, max_observations> rows;
    Eigen::Vector3d origin_site_m = Eigen::Vector3d::Zero();
    double correlation = 0; ///< between the noise of any two rows
    bool finite = true;     ///< every number was finite and every sigma above zero

    int anchor_count() const { return static_cast<int>(anchors_m.cols()) - 1; }
    auto real_anchors_m() const { return anchors_m.rightCols(anchor_count()); }
    /// The standard deviation that equal observations of the same total weight would have, m.
    double mean_sigma_m() const;
};

Epoch epoch_of(std::span<const RangeTo> ranges, const SolveSettings& settings) noexcept;
Epoch epoch_of(std::span<const DifferenceOf> differences, const SolveSettings& settings) noexcept;

} // namespace locus::uwb
