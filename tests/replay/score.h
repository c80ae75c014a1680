// How far an estimator was from the truth over a recorded flight, and whether its own bound was honest.
#pragma once

#include "fusion/estimators/estimator.h"
#include "fusion/geometry/error_bound.h"
#include "fusion/geometry/vector.h"
#include "tests/replay/crazyflie.h"

#include <Eigen/Dense>

#include <cmath>

namespace locus::crazyflie {

struct Score {
    double rmse_3d_m = 0;
    double rmse_2d_m = 0;
    double rmse_z_m = 0;
    double worst_m = 0;
    double within_2d = 0; ///< share of errors within the published 95 % radius; ellipsoid; interval
    double within_3d = 0;
    double within_z = 0;
    double sigma_2d_m = 0; ///< root mean of the estimator's own horizontal variance
    int ticks = 0;
    std::uint32_t resets = 0;
};

struct Window {
    double from_s = 0;
    double to_s = 0;
};

/// From the first to the last time that the body was higher than `height_m`.
inline Window airborne(const Flight& flight, double height_m) {
    Window window{1e18, 0};
    for (const Truth& truth : flight.truth) {
        if (truth.body_height_m <= height_m) continue;
        window.from_s = std::min(window.from_s, truth.time_s);
        window.to_s = truth.time_s;
    }
    return window;
}

inline std::optional<Eigen::Vector3d> antenna_at(const Flight& flight, double time_s) {
    const auto after = std::lower_bound(flight.truth.begin(), flight.truth.end(), time_s,
                                        [](const Truth& truth, double t) { return truth.time_s < t; });
    if (after == flight.truth.begin() || after == flight.truth.end()) return {};
    const Truth& before = *(after - 1);
    const double share = (time_s - before.time_s) / (after->time_s - before.time_s);
    return before.antenna_site_m + share * (after->antenna_site_m - before.antenna_site_m);
}

inline void add(Score& score, const Estimate& estimate, const Eigen::Vector3d& antenna_site_m) {
    const Eigen::Vector3d error = vector(estimate.position_site_m) - antenna_site_m;
    const Eigen::Map<const Eigen::Matrix<double, 6, 6, Eigen::RowMajor>> all(estimate.covariance.data());
    const Eigen::Matrix3d covariance = all.topLeftCorner<3, 3>();
    const Eigen::Matrix2d horizontal = covariance.topLeftCorner<2, 2>();
    const Eigen::Vector2d error_2d = error.head<2>();
    score.rmse_3d_m += error.squaredNorm();
    score.rmse_2d_m += error_2d.squaredNorm();
    score.rmse_z_m += error.z() * error.z();
    score.worst_m = std::max(score.worst_m, error.norm());
    score.within_2d +=
        error_2d.norm() <= double{horizontal_error_95_m(horizontal(0, 0), horizontal(0, 1), horizontal(1, 1))};
    score.within_3d += error.dot(covariance.inverse() * error) <= 7.815; // chi-square of three, 95 %
    score.within_z += std::abs(error.z()) <= double{vertical_error_95_m(covariance(2, 2))};
    score.sigma_2d_m += horizontal.trace();
    ++score.ticks;
}

/// Runs the estimator over the whole flight and looks at it a hundred times a second within the window: what it says
/// of a time when only measurements up to that time have gone in. A tick without a position counts as 100 m out.
inline Score run(Estimator& estimator, const Flight& flight, Window window) {
    Score score;
    auto next = flight.measurements.begin();
    for (double time_s = window.from_s; time_s < window.to_s; time_s += 0.01) {
        const Timestamp tick = timestamp_from_s(time_s);
        for (; next != flight.measurements.end() && next->time <= tick; ++next) estimator.update(*next);
        const auto antenna_site_m = antenna_at(flight, time_s);
        if (!antenna_site_m) continue;
        Estimate estimate = estimator.predict(tick);
        if (estimate.missing != Missing::nothing) estimate.position_site_m = {100, 100, 100};
        add(score, estimate, *antenna_site_m);
        score.resets = estimate.reset_count;
    }
    for (double* square : {&score.rmse_3d_m, &score.rmse_2d_m, &score.rmse_z_m, &score.sigma_2d_m})
        *square = std::sqrt(*square / score.ticks);
    for (double* share : {&score.within_2d, &score.within_3d, &score.within_z}) *share /= score.ticks;
    return score;
}

} // namespace locus::crazyflie
