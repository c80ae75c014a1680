#include "fusion/uwb/anchor_evidence.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace locus::uwb {
namespace {

/// An anchor is not moved by much more than this unnoticed, nor is an antenna delay wrong by more; it keeps what has
/// not been seen from enough sides from running away.
constexpr double weak_prior = 1 / (5.0 * 5.0);

} // namespace

void AnchorEvidence::add(const AnchorError& error, const Eigen::Vector3d& toward_tag, double weight) noexcept {
    if (!(error.information > 0)) return;
    Eigen::Vector4d row;
    row << -toward_tag, 1;
    information_.noalias() += (weight * error.information) * row * row.transpose();
    pull_ += (weight * error.pull) * row;
    squares_ += weight * error.pull * error.pull / error.information;
    looks_ += weight;
}

void AnchorEvidence::fade(double keep) noexcept {
    information_ *= keep;
    pull_ *= keep;
    squares_ *= keep;
    looks_ *= keep;
}

AnchorEvidence::Constant AnchorEvidence::constant() const noexcept {
    const double information = information_(3, 3);
    if (!(information > 0)) return {};
    return {pull_(3) / information, 1 / std::sqrt(information), pull_(3) * pull_(3) / (information + weak_prior)};
}

AnchorEvidence::Shift AnchorEvidence::shift() const noexcept {
    const Eigen::Matrix3d information = information_.topLeftCorner<3, 3>() + weak_prior * Eigen::Matrix3d::Identity();
    Shift shift;
    shift.covariance_m2 = information.llt().solve(Eigen::Matrix3d::Identity());
    shift.moved_m = shift.covariance_m2 * pull_.head<3>();
    shift.test = pull_.head<3>().dot(shift.moved_m);
    shift.misfit = looks_ > 0 ? std::max(0.0, squares_ - shift.test) / looks_ : 0;
    return shift;
}

double AnchorEvidence::test_of_both() const noexcept {
    const Eigen::Matrix4d information = information_ + weak_prior * Eigen::Matrix4d::Identity();
    return pull_.dot(information.llt().solve(pull_));
}

} // namespace locus::uwb
