// Where on a floor somebody is who hears this: Bayes' rule over the corners of a strength grid and its prior. For a
// first position, for a filter that lost its way, and for single fingerprints.
#pragma once

#include "fusion/radio/reading_noise.h"
#include "fusion/radio/strength_grid.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace locus::radio {

/// A beacon by its index in the grid.
struct IndexedReading {
    std::size_t beacon = 0;
    float rssi_dbm = 0;
    float offset_db = 0; ///< by which it is known to be stronger than the grid says
    float offset_variance_db2 = 0;
};

struct FloorBelief {
    Eigen::Vector2d position_site_m{0, 0}; ///< the mean: the least mean square error
    Eigen::Matrix2d covariance_m2 = Eigen::Matrix2d::Identity();
    double log_mean_likelihood = 0; ///< of the readings, over the floor
};

/// Logarithm of the likelihood of readings at a place; beacons of the grid that are not among them count as silent.
double log_likelihood(const StrengthGrid& grid, std::span<const IndexedReading> readings, const ReadingNoise& noise,
                      float x_site_m, float y_site_m) noexcept;

class FloorPosterior {
  public:
    explicit FloorPosterior(std::size_t corners, const ReadingNoise& noise = as_surveyed)
        : weights_(corners), noise_(noise) {}

    /// Does not allocate. `grid` has as many corners as was said.
    FloorBelief solve(const StrengthGrid& grid, std::span<const IndexedReading> readings) noexcept;

    const ReadingNoise& noise() const noexcept { return noise_; }
    /// Of the last solve(): a weight for each corner, their sum is one.
    const std::vector<float>& weights() const noexcept { return weights_; }

  private:
    std::vector<float> weights_;
    ReadingNoise noise_;
};

} // namespace locus::radio
