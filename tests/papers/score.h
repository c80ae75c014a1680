// Errors in the plane of estimators that hear the same walk.
#pragma once

#include "fusion/estimators/estimator.h"
#include "tests/papers/walk.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace locus::papers {

struct Score {
    double squares_m2 = 0, sum_m = 0;
    int poses = 0, none = 0; ///< none: moments without a pose
    int covered = 0;         ///< the truth lies within the 95 % ellipse
    std::vector<double> errors_m;

    void add(const Estimate& estimate, const Eigen::Vector3d& truth_m) {
        if (estimate.missing != Missing::nothing) {
            ++none;
            return;
        }
        const Eigen::Vector2d apart_m = (vector(estimate.position_site_m) - truth_m).head<2>();
        const Eigen::Matrix2d doubt_m2 =
            Eigen::Map<const Eigen::Matrix<double, 6, 6>>(estimate.covariance.data()).topLeftCorner<2, 2>();
        covered += apart_m.dot(doubt_m2.inverse() * apart_m) < 5.991; // chi-square of two, 95 %
        const double error_m = apart_m.norm();
        squares_m2 += error_m * error_m;
        sum_m += error_m;
        errors_m.push_back(error_m);
        ++poses;
    }
    double mse_m2() const { return squares_m2 / poses; }
    double rmse_m() const { return std::sqrt(mse_m2()); }
    double mean_m() const { return sum_m / poses; }
    double coverage() const { return static_cast<double>(covered) / poses; }
    /// The error that this share of them does not exceed.
    double share_m(double share) const {
        std::vector<double> sorted = errors_m;
        std::sort(sorted.begin(), sorted.end());
        return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1))];
    }
};

/// An estimator by its row, its settings changed by hand where the table of options has no say in the experiment.
template <class Settings>
std::unique_ptr<Estimator> planar(const char* name, const Site& site, Settings settings) {
    settings.planar = true;
    settings.height_m = tag_height_m;
    return find_estimator(name)->make(site, &settings);
}

} // namespace locus::papers
