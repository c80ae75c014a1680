// The figures of an evaluation: how far the estimate was from the truth, and whether its bounds held.
#pragma once

#include "tools/evaluate/align.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace locus::evaluate {

/// Of error magnitudes, in metres.
struct Figures {
    double rmse_m = 0;
    double mean_m = 0;
    double median_m = 0;
    double p80_m = 0;
    double p95_m = 0;
    double max_m = 0;
};

/// At least one error, none negative.
Figures figures(std::vector<double> errors_m);

/// Quantile by linear interpolation between the order statistics (Hyndman and Fan 1996, type 7). `sorted` is not empty.
double quantile(std::span<const double> sorted, double part);

/// How often the true error was within the published 95 % bound.
struct Coverage {
    double share = 0; ///< 0..1
    double mean_bound_m = 0;
    std::size_t count = 0; ///< poses that had a bound
};

struct Statistics {
    Figures spatial;
    Figures horizontal;
    std::array<Figures, 3> axes;
    std::array<double, 3> bias_m{}; ///< mean of estimate less truth along each axis
    /// Of the errors less their bias: an RMSE there is the standard deviation. For truths whose own place is uncertain.
    std::array<Figures, 3> axes_less_bias;
    Figures horizontal_less_bias;
    std::optional<Coverage> horizontal_coverage;
    std::optional<Coverage> vertical_coverage;
};

/// Estimate less truth at each pair, the estimate transformed.
std::vector<Eigen::Vector3d> errors(std::span<const Pair> pairs, const Similarity& similarity);

/// At least one pair. Bounds are scaled as the estimate is.
Statistics statistics(std::span<const Pair> pairs, const Similarity& similarity);

} // namespace locus::evaluate
