// Which anchor of an epoch is the odd one out? Every sighting's residual against a reference position is explained by
// a few unknowns: how far the reference is off, the error that all ranges have in common, and an error of each anchor
// that is in doubt already. Then each anchor in turn is given an error of its own: by how much that makes the rest
// agree better is its test. One anchor left out of a sum of squares and one anchor given a free error are the same
// thing (Baarda 1968, "A testing procedure for use in geodetic networks", 4; Teunissen 2006, "Testing theory", 4.2),
// and so it holds for range differences as well, where an anchor stands in many sightings and with either sign.
#pragma once

#include "fusion/uwb/sighting.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <span>

namespace locus::uwb {

/// A sighting, and where the tag was then as far as was known.
struct SightLine {
    Sighting sighting; ///< its sigma holds also the errors that anchors are known to have
    Eigen::Vector3d tag_site_m{0, 0, 0};
};

/// What is known of an epoch before it is heard.
struct EpochPrior {
    Eigen::Vector3d position_sigma_m{1, 1, 1}; ///< 0: that coordinate is known
    double common_sigma_m = 0;                 ///< of the error that all ranges have in common, about `common_m`
    double common_m = 0;
};

/// What the rest of an epoch says of one anchor's error: estimate pull / information, variance 1 / information.
struct AnchorError {
    double pull = 0;
    double information = 0;
};

class LeaveOneOut {
  public:
    static constexpr std::size_t max_in_doubt = 3;
    static constexpr std::size_t max_lines = 32;

    /// At most max_lines and max_in_doubt are looked at. No allocation, no exception.
    LeaveOneOut(const Site& site, std::span<const SightLine> lines, const EpochPrior& prior,
                std::span<const std::int16_t> in_doubt) noexcept;

    AnchorError error_of(std::int16_t anchor) const noexcept;

    /// The error that all ranges have in common, as the epoch and what was known before say it together.
    double common_m() const noexcept { return solution_(3); }
    double common_variance_m2() const noexcept { return inverse_(3, 3); }

  private:
    static constexpr int size = 4 + static_cast<int>(max_in_doubt);
    using Vector = Eigen::Matrix<double, size, 1>;
    using Matrix = Eigen::Matrix<double, size, size>;

    struct Row {
        std::int16_t plus, minus;
        double weight;
        double heard_m; ///< less what is expected with all unknowns zero
        Vector unknowns;

        double sign(std::int16_t anchor) const { return anchor == plus ? 1 : anchor == minus ? -1 : 0; }
    };
    Row row_of(const SightLine& line, const Site& site) const noexcept;
    void solve(const EpochPrior& prior) noexcept;

    std::array<std::int16_t, max_in_doubt> in_doubt_{};
    std::size_t in_doubt_count_;
    std::array<Row, max_lines> rows_;
    std::size_t row_count_;
    Vector solution_;
    Matrix inverse_; ///< of the normal equations: the covariance of the solution
};

} // namespace locus::uwb
