// By how much each anchor's ranges are off, from a walk: where the tag was and the anchors' errors together, by robust
// least squares over the whole recording, with a motion that changes its velocity only so fast. Offline: it allocates.
#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace locus::uwb::survey {

struct WalkRange {
    double time_s = 0;
    std::size_t anchor = 0; ///< index
    double range_m = 0;
    double sigma_m = 0.1; ///< of what is new each time
};

struct WalkSettings {
    /// Between two points of the path, which is straight in between: half a hand's width of sag at 2 m/s^2.
    double step_s = 0.2;
    /// How fast people and small drones change their velocity, 1 sigma over a step.
    double acceleration_mps2 = 2;
    /// Of what all anchors' biases have in common before anything is measured: modules whose antenna delay nobody set.
    double common_prior_m = 1;
    /// Of how far one anchor's bias is from the others': "up to 30 cm" between modules of one kind (Decawave APS014).
    double own_prior_m = 0.3;
    /// An anchor's error that stays for a while (antenna, body, multipath), and how long: as the range filter has it by
    /// default. A recording's many ranges say no more of a bias than it changes.
    double held_error_m = 0.2;
    double held_error_s = 0.3;
    /// Silence beyond which nothing is known of the motion: the path begins anew.
    double gap_s = 2;
};

struct Biases {
    bool solved = false;             ///< false: there is no path to start from
    Eigen::VectorXd bias_m;          ///< measured less true range, one an anchor
    Eigen::MatrixXd covariance;      ///< of the biases, with the correlation in time of what is left taken in
    std::vector<std::size_t> counts; ///< ranges of each anchor
    Eigen::VectorXd spread_m;        ///< of what is left of each anchor's ranges, robustly

    double sigma_m(Eigen::Index anchor) const;
    double common_sigma_m() const;                 ///< of the mean of all biases
    double own_sigma_m(Eigen::Index anchor) const; ///< of one bias less the mean of all
};

/// `anchors_m`: one row an anchor. `ranges` in order of time. Anchors without ranges keep the prior.
Biases biases_of_walk(const Eigen::Matrix<double, Eigen::Dynamic, 3>& anchors_m, const std::vector<WalkRange>& ranges,
                      const WalkSettings& settings);

/// A range whose true length is known.
struct KnownRange {
    std::size_t anchor = 0;
    double error_m = 0; ///< measured less true
};

/// The same where the track is known: each anchor by itself. In order of time; anchors without ranges keep `prior_m`.
Biases biases_of_errors(std::size_t anchors, const std::vector<KnownRange>& errors, double prior_m);

} // namespace locus::uwb::survey
