// What is known of every beacon's strength at every place of a floor: mean and variance in cells, worked out once, so
// that a cloud of particles can be weighed without solving anything. Where the knowledge comes from (a Gaussian process
// over a map, a path-loss model) is not seen any more.
#pragma once

#include "fusion/measurement.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace locus::radio {

/// Corners of the cells of a floor; values between them are interpolated in both directions.
struct FloorCells {
    Eigen::Vector2d corner_site_m{0, 0}; ///< of the lowest x and y
    double cell_m = 1;
    std::size_t columns = 2, rows = 2; ///< of corners, at least two each

    std::size_t count() const { return columns * rows; }
    Eigen::Vector2d place_site_m(std::size_t index) const {
        const std::size_t column = index % columns, row = index / columns;
        return corner_site_m + cell_m * Eigen::Vector2d(static_cast<double>(column), static_cast<double>(row));
    }
};

/// Cells over a box with at most `most` corners; `wanted_m` becomes larger where it must.
FloorCells cells_over(const Eigen::Vector2d& low_site_m, const Eigen::Vector2d& high_site_m, double wanted_m,
                      std::size_t most);

struct Expected {
    float mean_dbm = 0;
    float variance_db2 = 1;
};

class StrengthGrid {
  public:
    /// `beacons` rise. Memory is 12 bytes for each beacon and corner.
    StrengthGrid(const FloorCells& cells, std::vector<Address> beacons, double floor_dbm);

    static constexpr std::size_t none = static_cast<std::size_t>(-1);
    /// `none` when it is not of the grid.
    std::size_t index_of(Address beacon) const noexcept {
        const auto found = std::lower_bound(beacons_.begin(), beacons_.end(), beacon);
        return found == beacons_.end() || *found != beacon ? none : static_cast<std::size_t>(found - beacons_.begin());
    }

    void set(std::size_t beacon, std::size_t corner, const Expected& expected) noexcept;
    /// To be called when all is set: works out what silence says. `lost_share`: chance that a beacon in reach is not
    /// heard in a scan.
    void finish(double lost_share) noexcept;

    /// Logarithm of how likely somebody is at a corner before anything is heard, up to a constant; 0 unless set.
    void set_prior(std::size_t corner, float log_likelihood) noexcept { prior_[corner] = log_likelihood; }
    float prior(std::size_t corner) const noexcept { return prior_[corner]; }

    /// Places outside are taken to the edge.
    Expected at(std::size_t beacon, float x_site_m, float y_site_m) const noexcept;
    /// Logarithm of the chance that it is not heard in a scan: it is weaker than the hearing floor, or lost.
    float silence(std::size_t beacon, float x_site_m, float y_site_m) const noexcept;
    /// The same of all beacons together.
    float silence_of_all(float x_site_m, float y_site_m) const noexcept;

    const FloorCells& cells() const noexcept { return cells_; }
    const std::vector<Address>& beacons() const noexcept { return beacons_; }
    double floor_dbm() const noexcept { return floor_dbm_; }

  private:
    struct Place { ///< a corner and how far on to the next ones
        std::size_t corner;
        float right, up;
    };
    Place place(float x_site_m, float y_site_m) const noexcept;
    float between(const float* plane, const Place& place) const noexcept;

    FloorCells cells_;
    std::vector<Address> beacons_;
    double floor_dbm_;
    std::vector<float> mean_dbm_, variance_db2_, silence_, silence_of_all_, prior_;
};

} // namespace locus::radio
