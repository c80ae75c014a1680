// The similarity between a SLAM's path and the site, from ranges along the path: Gauss-Newton on
// |s R q + t - anchor| + what all ranges have in common, with Huber's weights. What cannot be told yet has a large
// variance instead of a number: while the target has hardly moved the scale's, on a straight way the turn about it.
#pragma once

#include "fusion/site.h"
#include "fusion/vision/scale/range_rows.h"
#include "fusion/vision/scale/similarity.h"

#include <optional>

namespace locus::vision {

struct SimilarityFitSettings {
    double drift_m_rtm = 0.05;         ///< of the SLAM's path against itself, m per root of a metre walked
    double time_offset_sigma_s = 0.1;  ///< that the two clocks may differ by; 0: they do not
    double common_range_sigma_m = 0.5; ///< of the error that all ranges have in common
};

struct SimilarityFit {
    Similarity similarity;
    double common_range_m = 0;
    Similarity::Matrix covariance = Similarity::Matrix::Zero();
    double misfit = 1; ///< mean square of the residuals over what was expected, at least 1; the covariance has it in it

    double relative_scale_sigma() const { return std::sqrt(covariance(0, 0)); }
    /// Of Similarity::place_site_m(), m^2.
    Eigen::Matrix3d place_covariance_m2(const Eigen::Vector3d& position_odometry,
                                        const Eigen::Vector3d& velocity_odometry_per_s) const;
};

/// From `start` on. Empty: it does not settle. Allocates nothing.
std::optional<SimilarityFit> fit_similarity(const SimilarityFit& start, std::span<const RangeRow> rows,
                                            const Site& site, const SimilarityFitSettings& settings) noexcept;

} // namespace locus::vision
