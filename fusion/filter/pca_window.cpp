#include "fusion/filter/pca_window.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace locus::filter {
namespace {

constexpr double clear_energy = 0.95;     ///< eq. 17
constexpr double principal_energy = 0.85; ///< eq. 16 and 17
constexpr int fewest_fixes = 5;

} // namespace

double degradation_factor(double energy_ratio) noexcept {
    if (energy_ratio > clear_energy) return 1;
    return energy_ratio >= principal_energy ? 1 / energy_ratio : 1 / (energy_ratio * energy_ratio);
}

void PcaWindow::keep(const Eigen::Vector3d& fix_m) noexcept {
    if (size_ == std::min(model_.window, most)) {
        std::copy(fixes_m_.begin() + 1, fixes_m_.begin() + size_, fixes_m_.begin());
        --size_;
    }
    fixes_m_[static_cast<std::size_t>(size_++)] = fix_m;
}

/// Eq. 14-15, of the covariance matrix.
PcaWindow::Axis PcaWindow::axis_of_newest(int count) const noexcept {
    const Eigen::Map<const Eigen::Matrix<double, 3, Eigen::Dynamic>> fixes(
        fixes_m_[static_cast<std::size_t>(size_ - count)].data(), 3, count);
    Axis axis;
    axis.centre_m = fixes.rowwise().mean();
    Eigen::Matrix3d scatter_m2 = Eigen::Matrix3d::Zero();
    for (int i = 0; i < count; ++i) {
        const Eigen::Vector3d from_centre = fixes.col(i) - axis.centre_m;
        scatter_m2.noalias() += from_centre * from_centre.transpose() / count;
    }
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(scatter_m2);
    axis.direction = solver.eigenvectors().col(2);
    axis.along_m2 = axis.direction.dot(scatter_m2 * axis.direction);
    axis.across_m2 = std::max(0.0, scatter_m2.trace() - axis.along_m2);
    return axis;
}

PcaWindow::Denoised PcaWindow::take(const Eigen::Vector3d& fix_m, const Eigen::Matrix3d& covariance_m2) noexcept {
    keep(fix_m);
    Denoised denoised{fix_m};
    for (int count = size_; count >= fewest_fixes; count -= std::max(1, count / 8)) {
        const Axis axis = axis_of_newest(count);
        const double noise_across_m2 = covariance_m2.trace() - axis.direction.dot(covariance_m2 * axis.direction);
        const double all_m2 = axis.along_m2 + axis.across_m2;
        denoised.length = count;
        denoised.energy_ratio = all_m2 > 0 ? axis.along_m2 / all_m2 : 1;
        denoised.degradation = degradation_factor(denoised.energy_ratio);
        if (axis.across_m2 > model_.straight * noise_across_m2) continue;
        if (denoised.energy_ratio >= principal_energy)
            denoised.position_m = axis.centre_m + axis.direction * axis.direction.dot(fix_m - axis.centre_m);
        break;
    }
    return denoised;
}

} // namespace locus::filter
