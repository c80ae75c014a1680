// What a monocular SLAM on a walking person tells: the way in a frame and a scale of its own, ten poses a second as
// paper 001's camera has frames. It drifts: each metre turns and stretches a little more, at random, by figures within
// the paper's "0.1 to 2 %" of the way. Where it is lost nothing comes, and after it all begins anew.
#pragma once

#include "fusion/geometry/rotation.h"
#include "fusion/geometry/vector.h"
#include "tests/papers/walk.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>
#include <optional>
#include <random>

namespace locus::papers {

struct SlamNoise {
    double place_m = 0.01;             ///< new with each pose, in the site's metres
    double stretch_rtm = 0.0015;       ///< of the scale's logarithm per root of a metre: 0.75 % after 25 m
    double turn_rad_rtm = 0.0015;      ///< about each axis
    double bob_m = 0.03, bob_hz = 1.8; ///< a walker's head goes up and down with each step
};

class SlamPath {
  public:
    SlamPath(unsigned seed, const SlamNoise& noise = {}) : random_(seed), noise_(noise) {}

    /// A pose of who is at `truth_site_m`; empty while it is lost.
    std::optional<VisualOdometry> see(const Eigen::Vector3d& truth_site_m, double time_s, bool lost) {
        if (lost) {
            began_ = false;
            return {};
        }
        Eigen::Vector3d here_m = truth_site_m;
        here_m.z() += noise_.bob_m * std::sin(2 * std::numbers::pi * noise_.bob_hz * time_s);
        if (!began_) begin(here_m);
        const Eigen::Vector3d way_m = here_m - before_m_;
        const double root_m = std::sqrt(way_m.norm());
        stretch_ *= std::exp(noise_.stretch_rtm * root_m * draw());
        turn_ = (rotation(noise_.turn_rad_rtm * root_m * three()) * turn_).normalized();
        gone_ += stretch_ * (turn_ * way_m);
        before_m_ = here_m;
        const Eigen::Vector3d told = gone_ + stretch_ * noise_.place_m * three();
        VisualOdometry odometry;
        odometry.camera = address(1);
        odometry.tag = tag_address;
        odometry.segment = segment_;
        odometry.position_odometry = {told.x(), told.y(), told.z()};
        return odometry;
    }

    /// Metres for a unit, and how the site is turned into its frame, both as they are now.
    double metres_per_unit() const { return 1 / stretch_; }
    const Eigen::Quaterniond& odometry_from_site() const { return turn_; }
    std::uint32_t segment() const { return segment_; }

  private:
    double draw() { return normal_(random_); }
    Eigen::Vector3d three() { return Eigen::Vector3d(draw(), draw(), draw()); }

    void begin(const Eigen::Vector3d& here_m) {
        began_ = true;
        ++segment_;
        before_m_ = here_m;
        gone_.setZero();
        stretch_ = std::exp(0.7 * draw()); // from a quarter to four units a metre, mostly
        const Eigen::Vector4d any(draw(), draw(), draw(), draw());
        turn_ = Eigen::Quaterniond(any.normalized());
    }

    std::mt19937 random_;
    std::normal_distribution<double> normal_;
    SlamNoise noise_;
    bool began_ = false;
    std::uint32_t segment_ = 0;
    double stretch_ = 1;
    Eigen::Quaterniond turn_ = Eigen::Quaterniond::Identity();
    Eigen::Vector3d before_m_ = Eigen::Vector3d::Zero(), gone_ = Eigen::Vector3d::Zero();
};

} // namespace locus::papers
