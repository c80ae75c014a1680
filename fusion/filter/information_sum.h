// The master of a federated filter: two local filters' knowledge of one target, added by information (paper 000 eq. 34;
// the first P11 in the paper's bracket is to be read P22). By the letter that is wrong: both locals expect the same
// target to turn and to stop, so their errors have that process noise in common, and the sum counts it as two opinions.
// Carlson's answer (1990, "Federated square root filter for decentralized parallel processes", IEEE Trans. AES 26(3),
// the variance upper bound): noise that both have in common, and what both believed at the start, has the covariance
//     [Q Q; Q Q]  <=  [Q / b1  0; 0  Q / b2]   for shares of information b1 + b2 = 1,
// so locals that work with Q / b1 and Q / b2 have errors whose joint covariance is at most that of two which know
// nothing of each other, and for these eq. 34 is right. The sum is then never too sure, however the two take turns.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>

namespace locus::filter {

/// Of a target in the plane: x, y (m), then their rates (m/s), with the covariance.
struct PlaneKnowledge {
    Eigen::Vector4d state = Eigen::Vector4d::Zero();
    Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();
};

/// Eq. 34 in gain form, (A^-1 + B^-1)^-1 = A - A (A + B)^-1 A: one may know next to nothing.
inline PlaneKnowledge sum_of_information(const PlaneKnowledge& a, const PlaneKnowledge& b) noexcept {
    const Eigen::LLT<Eigen::Matrix4d> both(a.covariance + b.covariance);
    const Eigen::Matrix4d root = both.matrixL().solve(a.covariance);
    PlaneKnowledge sum;
    sum.state = a.state + a.covariance * both.solve(b.state - a.state);
    sum.covariance.noalias() = a.covariance - root.transpose() * root;
    return sum;
}

/// Squared distance of the two places, weighed by what both own up to: chi-square of two if both are right.
inline double contradiction(const PlaneKnowledge& a, const PlaneKnowledge& b) noexcept {
    const Eigen::Matrix2d both = a.covariance.topLeftCorner<2, 2>() + b.covariance.topLeftCorner<2, 2>();
    const Eigen::Vector2d apart = b.state.head<2>() - a.state.head<2>();
    return apart.dot(both.llt().solve(apart));
}

} // namespace locus::filter
