// Denoising of positions by principal components, paper 000 eq. 12-17: over a window of fixes the axis of most energy
// is the way that the target walks, and what lies across it is noise and is taken off. The energy ratio of the two says
// how far the fixes are to be believed.
//
// By the letter it makes things worse, and here is what is done instead, and why:
// - Eq. 13 divides each coordinate by its own deviation. Of a walk along an axis that makes the noise across it as
// large
//   as the walk (E is near 0.5 whatever the noise), and it turns the direction of any other. Here the coordinates keep
//   their metres, and the matrix is their covariance.
// - The paper's window runs over corners, where the axis is nobody's way. Here it is cut from its old end until what is
//   left is straight: spread across the axis no more than the fixes' own covariance accounts for.
// - Where the principal axis holds less than 85 % of the energy, eq. 16's bar for a principal component, there is no
//   axis to go by (a target at rest, the first steps round a corner) and the fix is left as it came.
#pragma once

#include <Eigen/Core>

#include <array>

namespace locus::filter {

struct PcaModel {
    int window = 100;    ///< fixes at most, 5 to PcaWindow::most
    double straight = 1; ///< variance across the axis, over that of the fixes, that is still straight
};

class PcaWindow {
  public:
    static constexpr int most = 256;

    struct Denoised {
        Eigen::Vector3d position_m;
        double energy_ratio = 1; ///< E of eq. 17, in 3D of the first axis to all three
        double degradation = 1;  ///< alpha of eq. 17, factor of the fix's covariance in eq. 21
        int length = 0;          ///< of the straight piece, fixes
    };

    explicit PcaWindow(const PcaModel& model) noexcept : model_(model) {}

    /// Takes the newest fix, m and m^2, into the window. In the plane its covariance and changes in z are zero.
    Denoised take(const Eigen::Vector3d& fix_m, const Eigen::Matrix3d& covariance_m2) noexcept;

  private:
    struct Axis {
        Eigen::Vector3d centre_m;
        Eigen::Vector3d direction;
        double along_m2 = 0, across_m2 = 0; ///< variances
    };
    void keep(const Eigen::Vector3d& fix_m) noexcept;
    Axis axis_of_newest(int count) const noexcept;

    PcaModel model_;
    std::array<Eigen::Vector3d, most> fixes_m_{}; ///< oldest first
    int size_ = 0;
};

/// Alpha of eq. 17.
double degradation_factor(double energy_ratio) noexcept;

} // namespace locus::filter
