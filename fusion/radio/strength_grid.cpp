#include "fusion/radio/strength_grid.h"

#include <cmath>
#include <numbers>

namespace locus::radio {
namespace {

/// Of the standard normal distribution.
double share_below(double sigmas) { return 0.5 * std::erfc(-sigmas / std::numbers::sqrt2); }

std::size_t corners_along(double length_m, double cell_m) {
    return static_cast<std::size_t>(std::ceil(length_m / cell_m - 1e-9)) + 1;
}

FloorCells with_cell(const Eigen::Vector2d& low_m, const Eigen::Vector2d& size_m, double cell_m) {
    return {low_m, cell_m, std::max<std::size_t>(2, corners_along(size_m.x(), cell_m)),
            std::max<std::size_t>(2, corners_along(size_m.y(), cell_m))};
}

} // namespace

FloorCells cells_over(const Eigen::Vector2d& low_site_m, const Eigen::Vector2d& high_site_m, double wanted_m,
                      std::size_t most) {
    constexpr double coarser = 1.1;
    const Eigen::Vector2d size_m = (high_site_m - low_site_m).cwiseMax(0.0);
    // Before anything is counted, so that no size can make a count that does not fit.
    double cell_m = std::max(wanted_m, size_m.maxCoeff() / static_cast<double>(most));
    FloorCells cells = with_cell(low_site_m, size_m, cell_m);
    while (cells.count() > std::max<std::size_t>(most, 4)) cells = with_cell(low_site_m, size_m, cell_m *= coarser);
    return cells;
}

StrengthGrid::StrengthGrid(const FloorCells& cells, std::vector<Address> beacons, double floor_dbm)
    : cells_(cells), beacons_(std::move(beacons)), floor_dbm_(floor_dbm) {
    mean_dbm_.assign(beacons_.size() * cells.count(), static_cast<float>(floor_dbm));
    variance_db2_.assign(mean_dbm_.size(), 1);
    silence_.assign(mean_dbm_.size(), 0);
    silence_of_all_.assign(cells.count(), 0);
    prior_.assign(cells.count(), 0);
}

void StrengthGrid::set(std::size_t beacon, std::size_t corner, const Expected& expected) noexcept {
    mean_dbm_[beacon * cells_.count() + corner] = expected.mean_dbm;
    variance_db2_[beacon * cells_.count() + corner] = expected.variance_db2;
}

void StrengthGrid::finish(double lost_share) noexcept {
    std::fill(silence_of_all_.begin(), silence_of_all_.end(), 0.0f);
    for (std::size_t i = 0; i < silence_.size(); ++i) {
        const double sigmas = (floor_dbm_ - double{mean_dbm_[i]}) / std::sqrt(double{variance_db2_[i]});
        silence_[i] = static_cast<float>(std::log(lost_share + (1 - lost_share) * share_below(sigmas)));
        silence_of_all_[i % cells_.count()] += silence_[i];
    }
}

StrengthGrid::Place StrengthGrid::place(float x_site_m, float y_site_m) const noexcept {
    const auto along = [this](float value_m, double corner_m, std::size_t count) {
        const auto last = static_cast<float>(count - 1);
        const float cells = (value_m - static_cast<float>(corner_m)) / static_cast<float>(cells_.cell_m);
        return cells >= 0 ? std::min(cells, last) : 0.0f; // what is no number is at the edge as well
    };
    const float across = along(x_site_m, cells_.corner_site_m.x(), cells_.columns);
    const float upward = along(y_site_m, cells_.corner_site_m.y(), cells_.rows);
    const std::size_t column = std::min(static_cast<std::size_t>(across), cells_.columns - 2);
    const std::size_t row = std::min(static_cast<std::size_t>(upward), cells_.rows - 2);
    return {row * cells_.columns + column, across - static_cast<float>(column), upward - static_cast<float>(row)};
}

float StrengthGrid::between(const float* plane, const Place& place) const noexcept {
    const float* low = plane + place.corner;
    const float* high = low + cells_.columns;
    const float below = low[0] + place.right * (low[1] - low[0]);
    const float above = high[0] + place.right * (high[1] - high[0]);
    return below + place.up * (above - below);
}

Expected StrengthGrid::at(std::size_t beacon, float x_site_m, float y_site_m) const noexcept {
    const Place here = place(x_site_m, y_site_m);
    const std::size_t first = beacon * cells_.count();
    return {between(mean_dbm_.data() + first, here), between(variance_db2_.data() + first, here)};
}

float StrengthGrid::silence(std::size_t beacon, float x_site_m, float y_site_m) const noexcept {
    return between(silence_.data() + beacon * cells_.count(), place(x_site_m, y_site_m));
}

float StrengthGrid::silence_of_all(float x_site_m, float y_site_m) const noexcept {
    return between(silence_of_all_.data(), place(x_site_m, y_site_m));
}

} // namespace locus::radio
