// Any estimator against the posterior Cramer-Rao bound: a tag that manoeuvres by the model that `truth` states, sweeps
// of ranges past all anchors, and the least mean square error that any estimator of position can have that knows the
// model and has heard the same sweeps (Tichavsky, Muravchik, Nehorai 1998; for linear motion the recursion is J+ = (Q +
// F J^-1 F')^-1 + E[H' R^-1 H], the mean over the simulated truths).
#pragma once

#include "fusion/estimators/estimator.h"
#include "tests/support/heavy.h"
#include "tests/unit/fusion/simulated_tag.h"

#include <cmath>
#include <random>
#include <vector>

namespace locus::test {

/// The hall of simulated_tag.h made 32 m x 32 m x 12 m, so that a manoeuvring tag stays among the anchors.
inline Site large_hall() {
    Site site = hall();
    for (Anchor& anchor : site.anchors)
        for (double& coordinate : anchor.position_site_m) coordinate *= 4;
    return site;
}
/// Its corners at one height: for the plane.
inline Site four_corners() {
    Site site = large_hall();
    std::erase_if(site.anchors, [](const Anchor& anchor) { return anchor.position_site_m[2] < 6; });
    return site;
}

/// Ranges that are too long, each by itself or, with a `held_s`, an anchor's for some time on end.
struct Blockage {
    double share = 0;
    double least_m = 0.3, most_m = 1.5;
    double held_s = 0; ///< mean time that a blocked path stays so, and stays as much too long; 0: drawn anew each time
};

class BlockedPaths {
  public:
    BlockedPaths(const Blockage& blockage, std::size_t anchors, unsigned seed)
        : blockage_(blockage), random_(seed), longer_m_(anchors) {
        for (double& longer_m : longer_m_) longer_m = draw();
    }

    void move(double dt_s) {
        const double keep = blockage_.held_s > 0 ? std::exp(-dt_s / blockage_.held_s) : 0;
        for (double& longer_m : longer_m_)
            if (unit_(random_) > keep) longer_m = draw();
    }
    double longer_m(std::size_t anchor) const { return longer_m_[anchor]; }

  private:
    double draw() {
        const bool blocked = unit_(random_) < blockage_.share;
        const double much = unit_(random_);
        return blocked ? blockage_.least_m + much * (blockage_.most_m - blockage_.least_m) : 0;
    }

    Blockage blockage_;
    std::mt19937 random_;
    std::uniform_real_distribution<double> unit_;
    std::vector<double> longer_m_;
};

struct BoundTrial {
    Site site;
    RangeEkfSettings truth; ///< what the tag and its ranges are drawn from; held and common errors must be zero
    Blockage blockage;
    double sweep_s = 0.1;
    int sweeps = 60; ///< the later half is scored
    int runs = 200;
};

struct BoundResult {
    double rmse_m = 0;
    double bound_m = 0; ///< without blocked paths
    int without_pose = 0;

    double ratio() const { return rmse_m / bound_m; }
};

class PosteriorBound {
  public:
    explicit PosteriorBound(const BoundTrial& trial)
        : trial_(trial), information_(static_cast<std::size_t>(trial.sweeps), Eigen::Matrix3d::Zero()) {}

    /// What one sweep heard at `position_m` tells of it, H' R^-1 H.
    void hear(int sweep, const Eigen::Vector3d& position_m) {
        for (const Anchor& anchor : trial_.site.anchors) {
            const Eigen::Vector3d direction = (position_m - vector(anchor.position_site_m)).normalized();
            const double variance = trial_.truth.range_sigma_m * trial_.truth.range_sigma_m * trial_.runs;
            information_[static_cast<std::size_t>(sweep)] += direction * direction.transpose() / variance;
        }
    }

    /// Trace of the position's bound after each sweep, m^2.
    std::vector<double> traces_m2() const {
        const int axes = trial_.truth.planar ? 2 : 3;
        const RangeEkfSettings& s = trial_.truth;
        const auto step = filter::axis_step({s.acceleration_sigma_mps2, s.acceleration_time_s}, trial_.sweep_s);
        Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(3 * axes, 3 * axes), transition = covariance,
                        noise = covariance;
        for (int i = 0; i < axes; ++i) {
            const double speed = s.speed_sigma_mps, acceleration = s.acceleration_sigma_mps2;
            covariance.block<3, 3>(3 * i, 3 * i).diagonal() << 1e4, speed * speed, acceleration * acceleration;
            transition.block<3, 3>(3 * i, 3 * i) = step.transition;
            noise.block<3, 3>(3 * i, 3 * i) = step.noise;
        }
        std::vector<double> traces;
        for (const Eigen::Matrix3d& heard : information_) {
            if (!traces.empty()) covariance = carried(transition, covariance) + noise;
            Eigen::MatrixXd posterior = inverse(covariance);
            for (int i = 0; i < axes; ++i)
                for (int j = 0; j < axes; ++j) posterior(3 * i, 3 * j) += heard(i, j);
            covariance = inverse(posterior);
            double trace = 0;
            for (int i = 0; i < axes; ++i) trace += covariance(3 * i, 3 * i);
            traces.push_back(trace);
        }
        return traces;
    }

  private:
    BoundTrial trial_;
    std::vector<Eigen::Matrix3d> information_; ///< mean over the runs
};

/// `make(site)` gives a fresh estimator. Seeds are 1 to runs. A moment without a pose is counted and not scored.
template <class Make>
BoundResult against_bound(const BoundTrial& trial, const Make& make) {
    BoundResult result;
    PosteriorBound bound(trial);
    const int settled = trial.sweeps / 2;
    for (unsigned seed = 1; seed <= static_cast<unsigned>(trial.runs); ++seed) {
        const auto estimator = make(trial.site);
        SimulatedTag tag(trial.site, trial.truth, seed);
        BlockedPaths paths(trial.blockage, trial.site.anchors.size(), seed + 1000);
        for (int sweep = 0; sweep < trial.sweeps; ++sweep) {
            if (sweep > 0) tag.move(trial.sweep_s);
            paths.move(trial.sweep_s);
            for (std::size_t i = 0; i < trial.site.anchors.size(); ++i) {
                Measurement measurement = tag.range(i);
                std::get_if<Range>(&measurement.observation)->range_m += paths.longer_m(i);
                estimator->update(measurement);
            }
            const Eigen::Vector3d truth_m = tag.motion().row(0);
            bound.hear(sweep, truth_m);
            if (sweep < settled) continue;
            const Estimate estimate = estimator->predict(timestamp_from_s(tag.time_s()));
            if (estimate.missing != Missing::nothing)
                ++result.without_pose;
            else
                result.rmse_m += (vector(estimate.position_site_m) - truth_m).squaredNorm();
        }
    }
    const std::vector<double> traces = bound.traces_m2();
    for (std::size_t i = static_cast<std::size_t>(settled); i < traces.size(); ++i) result.bound_m += traces[i];
    const int scored = trial.sweeps - settled;
    result.bound_m = std::sqrt(result.bound_m / scored);
    result.rmse_m = std::sqrt(result.rmse_m / (scored * trial.runs - result.without_pose));
    return result;
}

} // namespace locus::test
