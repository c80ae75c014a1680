#include "fusion/radio/floor_posterior.h"

#include <cmath>
#include <limits>

namespace locus::radio {

double log_likelihood(const StrengthGrid& grid, std::span<const IndexedReading> readings, const ReadingNoise& noise,
                      float x_site_m, float y_site_m) noexcept {
    auto sum = double{grid.silence_of_all(x_site_m, y_site_m)};
    for (const IndexedReading& reading : readings) {
        const Expected expected = grid.at(reading.beacon, x_site_m, y_site_m);
        const float off = reading.rssi_dbm - reading.offset_db - expected.mean_dbm;
        const float variance = expected.variance_db2 + reading.offset_variance_db2;
        sum += double{log_likelihood(off, variance, noise) - grid.silence(reading.beacon, x_site_m, y_site_m)};
    }
    return sum;
}

FloorBelief FloorPosterior::solve(const StrengthGrid& grid, std::span<const IndexedReading> readings) noexcept {
    float most = -std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < weights_.size(); ++i) {
        const Eigen::Vector2f place = grid.cells().place_site_m(i).cast<float>();
        const double log = log_likelihood(grid, readings, noise_, place.x(), place.y());
        weights_[i] = static_cast<float>(log) + grid.prior(i);
        most = std::max(most, weights_[i]);
    }
    double sum = 0;
    for (float& weight : weights_) sum += double{weight = std::exp(weight - most)};
    FloorBelief belief;
    belief.log_mean_likelihood = double{most} + std::log(sum / static_cast<double>(weights_.size()));
    Eigen::Matrix2d square = Eigen::Matrix2d::Zero();
    for (std::size_t i = 0; i < weights_.size(); ++i) {
        weights_[i] = static_cast<float>(double{weights_[i]} / sum);
        const Eigen::Vector2d place = grid.cells().place_site_m(i);
        belief.position_site_m += double{weights_[i]} * place;
        square += double{weights_[i]} * (place - grid.cells().corner_site_m) *
                  (place - grid.cells().corner_site_m).transpose();
    }
    const Eigen::Vector2d mean = belief.position_site_m - grid.cells().corner_site_m;
    const double within = grid.cells().cell_m * grid.cells().cell_m / 12; // somewhere in the cell
    belief.covariance_m2 = square - mean * mean.transpose() + within * Eigen::Matrix2d::Identity();
    return belief;
}

} // namespace locus::radio
