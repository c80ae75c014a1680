// Anchors that measured each other: where they stand, by robust least squares. Offline: it allocates, and no estimator
// calls it.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace locus::uwb::survey {

/// Distance between two stations, by their index, as measured.
struct PairRange {
    std::size_t a = 0;
    std::size_t b = 0;
    double range_m = 0;
    double sigma_m = 0.1;
};

/// One row a station, x, y, z.
using Positions = Eigen::Matrix<double, Eigen::Dynamic, 3>;
/// One row a station: which coordinates are sought. The others stay as they are.
using Sought = Eigen::Array<bool, Eigen::Dynamic, 3>;

/// Where half of a pair's weight is gone, in standard deviations: 95 % of the efficiency of least squares on normal
/// errors (Zhang 1997, table 1).
inline constexpr double half_weight_sigma = 2.385;
/// Covariance of the estimate over the inverse of the weighted information, for normal errors:
/// E[psi^2] E[w] / E[psi']^2 at that scale (Huber 1981, section 7.6).
inline constexpr double robust_covariance_factor = 0.924;

struct PairFit {
    double residual_m = 0; ///< measured less what the positions say
    double weight = 1;     ///< 0..1: what it still counts
    double normalised = 0; ///< residual over its own standard deviation; 0 where nothing controls the pair
};

struct Adjustment {
    Positions position_m;
    Positions sigma_m; ///< 0 of what was not sought, infinite of what the pairs do not determine
    std::vector<PairFit> pairs;
    double cost = 0;    ///< sum of k^2 log(1 + (residual / (k sigma))^2)
    int redundancy = 0; ///< pairs less unknowns
    double scale =
        1; ///< by how much standard deviations were widened, because residuals are larger than they should be
};

struct Descent {
    Positions position_m;
    double cost = 0;
};

/// Levenberg-Marquardt with Cauchy weights: the better of two ways down, at once and with weights at first so wide that
/// nothing is an outlier. `start_m` also holds what is not sought. Pairs of a station with itself or beyond the
/// stations are not looked at.
Descent descend(const std::vector<PairRange>& pairs, const Sought& sought, const Positions& start_m);

/// The same, starting as well from where least squares end when one pair after the other is taken out whose residual is
/// the largest and beyond 4 of its own standard deviations (data snooping, Baarda 1968), a quarter of them at most.
Descent descend_snooping(const std::vector<PairRange>& pairs, const Sought& sought, const Positions& start_m);

/// descend() with standard deviations and what becomes of each pair.
Adjustment adjust(const std::vector<PairRange>& pairs, const Sought& sought, const Positions& start_m);

} // namespace locus::uwb::survey
