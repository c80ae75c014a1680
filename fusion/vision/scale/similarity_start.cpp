#include "fusion/vision/scale/similarity_start.h"

#include <Eigen/Dense>

#include <cmath>

namespace locus::vision {
namespace {

constexpr std::size_t least_places = 4;

struct Means {
    double weight = 0;
    Eigen::Vector3d odometry = Eigen::Vector3d::Zero(), site_m = Eigen::Vector3d::Zero();
};

Means means_of(std::span<const KeyPlace> places) {
    Means mean;
    for (const KeyPlace& place : places) {
        mean.weight += place.weight;
        mean.odometry += place.weight * place.position_odometry;
        mean.site_m += place.weight * place.position_site_m;
    }
    mean.odometry /= mean.weight;
    mean.site_m /= mean.weight;
    return mean;
}

/// Horn's matrix: a unit quaternion q turns the path so that it agrees with the places by q' N q.
Eigen::Matrix4d agreement_of_turns(const Eigen::Matrix3d& cross) {
    const Eigen::Matrix3d s = cross.transpose();
    Eigen::Matrix4d n;
    n(0, 0) = s.trace();
    n.block<1, 3>(0, 1) << s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0);
    n.block<3, 1>(1, 0) = n.block<1, 3>(0, 1).transpose();
    n.block<3, 3>(1, 1) = s + s.transpose() - s.trace() * Eigen::Matrix3d::Identity();
    return n;
}

} // namespace

std::optional<Similarity> start_of_similarity(std::span<const KeyPlace> places) noexcept {
    if (places.size() < least_places) return {};
    const Means mean = means_of(places);
    Eigen::Matrix3d cross = Eigen::Matrix3d::Zero();
    double spread = 0;
    for (const KeyPlace& place : places) {
        const Eigen::Vector3d odometry = place.position_odometry - mean.odometry;
        const Eigen::Vector3d site_m = place.position_site_m - mean.site_m;
        cross += place.weight / mean.weight * site_m * odometry.transpose();
        spread += place.weight / mean.weight * odometry.squaredNorm();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> turns(agreement_of_turns(cross));
    const double scale = turns.eigenvalues()(3) / spread;
    if (!(spread > 0) || !(scale > 0) || !std::isfinite(scale)) return {};
    const Eigen::Vector4d wxyz = turns.eigenvectors().col(3);
    const Eigen::Quaterniond turn(wxyz(0), wxyz(1), wxyz(2), wxyz(3));
    return Similarity{std::log(scale), turn, mean.site_m, mean.odometry, 0};
}

} // namespace locus::vision
