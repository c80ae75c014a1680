// A position from one epoch of ranges or range differences, without a prior: Chan's closed form (paper 000 eq. 3-7)
// and Taylor refinement (eq. 8-11), started from Chan's point and from the anchors' centroid, lower cost kept.
#pragma once

#include "fusion/aid_status.h"
#include "fusion/measurement.h"

#include <array>
#include <span>

namespace locus::uwb {

struct RangeTo {
    Vec3 anchor_site_m{};
    double range_m = 0;
    double sigma_m = 0.1;
};

/// distance(x, b) - distance(x, a) = difference_m, with independent noise.
struct DifferenceOf {
    Vec3 anchor_a_site_m{};
    Vec3 anchor_b_site_m{};
    double difference_m = 0;
    double sigma_m = 0.1;
};

inline constexpr std::size_t max_observations = 64;

struct SolveSettings {
    bool planar = false;      ///< solve for x and y at height_site_m
    double height_site_m = 0; ///< the tag's height when planar
    double max_pdop = 20;     ///< above it the geometry is refused as degenerate
    /// Between the noise of any two differences. 0: independent. 0.5: all share anchor a and every arrival has the same
    /// noise, so R = sigma^2 / 2 (I + 11'). Only for differences with one common anchor a.
    double difference_correlation = 0;
};

struct Fix {
    Exclusion reason = Exclusion::geometry_too_few; ///< none: the fix is good; else why there is none
    Vec3 position_site_m{};
    std::array<double, 9> covariance_m2{}; ///< row-major; zero in z when planar
    double cost = 0;                       ///< sum of squared residuals over sigma
    int degrees_of_freedom = 0;
    double pdop = 0;
    bool starts_disagree = false; ///< the two starts ended in different minima
};

/// At most max_observations are looked at. No allocation, no exception.
Fix solve_ranges(std::span<const RangeTo> ranges, const SolveSettings& settings) noexcept;
Fix solve_differences(std::span<const DifferenceOf> differences, const SolveSettings& settings) noexcept;

} // namespace locus::uwb
