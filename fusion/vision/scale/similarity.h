// Seven degrees and one: what turns the path of a monocular SLAM into the site's, and by how much their clocks differ.
// A SLAM with one camera knows its path but for an origin, a rotation and a scale (Umeyama 1991, "Least-squares
// estimation of transformation parameters between two point patterns").
#pragma once

#include <Eigen/Geometry>

#include <cmath>

namespace locus::vision {

struct Similarity {
    /// Rows and columns of its covariance: what a small error is made of.
    enum Part : int { log_scale_at = 0, turn_at = 1, origin_at = 4, offset_at = 7, size = 8 };
    using Vector = Eigen::Matrix<double, size, 1>;
    using Matrix = Eigen::Matrix<double, size, size>;
    using Jacobian = Eigen::Matrix<double, 3, size>;

    double log_scale = 0; ///< of metres for a unit of the odometry
    Eigen::Quaterniond site_from_odometry = Eigen::Quaterniond::Identity();
    Eigen::Vector3d origin_site_m = Eigen::Vector3d::Zero(); ///< where `centre_odometry` lies
    Eigen::Vector3d centre_odometry = Eigen::Vector3d::Zero();
    double offset_s = 0; ///< the odometry's stamps are so much later than the same moment in the ranges' clock

    double scale() const { return std::exp(log_scale); }
    Eigen::Vector3d turned_m(const Eigen::Vector3d& odometry) const {
        return scale() * (site_from_odometry * odometry);
    }

    /// Where the target is at the stamp of an odometry's pose.
    Eigen::Vector3d place_site_m(const Eigen::Vector3d& position_odometry,
                                 const Eigen::Vector3d& velocity_odometry_per_s) const;
    /// Of that place by (logarithm of the scale, turn about the site's axes in rad, origin in m, offset in s).
    Jacobian jacobian(const Eigen::Vector3d& position_odometry, const Eigen::Vector3d& velocity_odometry_per_s) const;

    /// The same moved by a small error, in the order of Part.
    void move_by(const Vector& step);
};

} // namespace locus::vision
