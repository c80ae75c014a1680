// The view of a floor that fits pairs of pixels and places best, and how sure it is: least squares of pixel errors,
// each weighted by the pixel's own error and by what the place's error is in the image (Levenberg-Marquardt). Where
// places come from a path, the path's clock may be fitted with it. Offline: it allocates.
#pragma once

#include "fusion/vision/survey/floor_pair.h"
#include "fusion/vision/survey/floor_sight.h"

#include <Eigen/Core>

#include <span>
#include <vector>

namespace locus::vision::survey {

/// A pair whose place moves as the time offset grows; a surveyed place does not.
struct TimedPair : FloorPair {
    Eigen::Vector2d velocity_mps{0, 0};
};

struct Residual {
    Eigen::Vector2d error_px{0, 0}; ///< seen less expected
    double test = 0;                ///< squared, over its covariance: chi-square with two degrees of freedom
    double cost = 0;                ///< -2 ln of its density, 1/px2
    double floor_m = 0;             ///< the same error on the floor
    bool is_seen = false;           ///< false: the view does not show this place, the rest says nothing
};

Residual residual_of(const FloorView& view, const FloorPair& pair) noexcept;

/// One step's worth of a fit: the view's parameters, and last the time offset, s, if that is fitted.
struct NormalEquations {
    Eigen::MatrixXd information;
    Eigen::VectorXd gradient; ///< points to where the cost falls
    double cost = 0;          ///< sum of the residuals' tests
};

NormalEquations normal_equations(const FloorView& view, std::span<const TimedPair> pairs,
                                 const Eigen::Vector2d& centre_m, bool with_offset);

/// Whether it has full rank, after each parameter was given its own unit.
bool is_determined(const Eigen::MatrixXd& information);

/// The mean of the places: steps of a homography are about it.
Eigen::Vector2d centre_of(std::span<const TimedPair> pairs);

struct FloorFit {
    FloorView view;
    Eigen::MatrixXd covariance; ///< of the parameters, as the pairs' own errors make it
    Eigen::Vector2d centre_m{0, 0};
    std::vector<Residual> residuals; ///< one a pair
    bool is_told = false;            ///< whether the pairs determine all parameters
};

/// From a first view, for places that do not move. Pairs: at least as many numbers as parameters.
FloorFit fit_view(const FloorView& start, std::span<const TimedPair> pairs);

/// A place's covariance on the floor as the fit's alone makes it, m^2; infinite where the view does not show it.
Eigen::Matrix2d floor_covariance_m2(const FloorFit& fit, const Eigen::Vector2d& site_m);

/// Standard deviation of the camera's position along x, y, z, m. Only of a view that is a camera.
Eigen::Vector3d position_sigma_m(const FloorFit& fit);

} // namespace locus::vision::survey
