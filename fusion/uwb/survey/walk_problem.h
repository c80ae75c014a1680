// Path and biases of one walk as one least-squares problem.
#pragma once

#include "fusion/measurement.h"
#include "fusion/uwb/range_model.h"
#include "fusion/uwb/survey/walk_path.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace locus::uwb::survey {

using Anchors = Eigen::Matrix<double, Eigen::Dynamic, 3>;

class WalkProblem {
  public:
    WalkProblem(const Anchors& anchors_m, const std::vector<WalkRange>& ranges, const WalkSettings& settings)
        : anchors_m_{anchors_m}, ranges_{ranges}, settings_{settings}, knots_{ranges, settings},
          path_m_{Eigen::Matrix3Xd::Zero(3, static_cast<Eigen::Index>(knots_.size()))},
          bias_m_{Eigen::VectorXd::Zero(anchors_m.rows())}, rate_hz_{rates()} {}

    bool start();
    void descend();

    /// Of one range among its like: over a long time as many ranges as there are say no more of a constant than this
    /// has them say. The held error's variance over a time t is 2 T / t times its own, of r t ranges.
    double worth_m(const WalkRange& range) const {
        const double together = 2 * settings_.held_error_s * rate_hz_[range.anchor];
        return std::hypot(range.sigma_m, std::sqrt(std::max(together, 1.0)) * settings_.held_error_m);
    }
    const Eigen::VectorXd& bias_m() const { return bias_m_; }
    /// What is left of every range, in their order, and the information of path and biases, the biases last.
    std::vector<double> left_m() const;
    Eigen::SparseMatrix<double> information() const { return equations(1).information(); }

  private:
    const Anchors& anchors_m_;
    const std::vector<WalkRange>& ranges_;
    const WalkSettings& settings_;
    Knots knots_;
    Eigen::Matrix3Xd path_m_;
    Eigen::VectorXd bias_m_;
    std::vector<double> rate_hz_; ///< ranges a second of each anchor

    struct Place {
        std::size_t knot = 0;
        double share = 0;
        Sight sight;
    };

    std::size_t bias_at(std::size_t anchor) const { return 3 * knots_.size() + anchor; }
    Place place_of(const WalkRange& range) const;
    double residual_m(const WalkRange& range, const Place& place) const {
        return range.range_m - place.sight.range_m - bias_m_(static_cast<Eigen::Index>(range.anchor));
    }
    std::vector<double> rates() const;
    /// Of one range by itself: by it a range is an outlier.
    double spread_m(const WalkRange& range) const { return std::hypot(range.sigma_m, settings_.held_error_m); }
    std::optional<Vec3> fix_about(double time_s) const;
    void add_range(Equations& equations, const WalkRange& range, double widening) const;
    void add_motion(Equations& equations) const;
    void add_prior(Equations& equations) const;
    Equations equations(double widening) const;
    double step(double widening);
};

} // namespace locus::uwb::survey
