// Whether one anchor's errors, seen from many places, are those of an anchor that stands elsewhere or those of one
// whose ranges are all too long. An anchor moved by d is seen from the direction u with ranges too long by -u'd, a
// constant c adds to that: linear in (d, c), so four by four sums hold all that was seen, and old ones fade.
#pragma once

#include "fusion/uwb/leave_one_out.h"

#include <Eigen/Core>

namespace locus::uwb {

class AnchorEvidence {
  public:
    /// `toward_tag`: unit vector from the anchor to the tag. `weight`: 0..1 of an independent look.
    void add(const AnchorError& error, const Eigen::Vector3d& toward_tag, double weight) noexcept;
    /// What was seen counts for `keep` of itself.
    void fade(double keep) noexcept;
    void clear() noexcept { *this = {}; }

    /// Independent looks, faded.
    double looks() const noexcept { return looks_; }

    struct Constant {
        double error_m = 0;
        double sigma_m = 0;
        double test = 0; ///< chi-square that it takes away
    };
    Constant constant() const noexcept;

    struct Shift {
        Eigen::Vector3d moved_m = Eigen::Vector3d::Zero();
        Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
        double test = 0;
        double misfit = 0; ///< chi-square that it leaves, per look; 1 where it explains all
    };
    Shift shift() const noexcept;

    /// Chi-square that both together take away.
    double test_of_both() const noexcept;

  private:
    Eigen::Matrix4d information_ = Eigen::Matrix4d::Zero();
    Eigen::Vector4d pull_ = Eigen::Vector4d::Zero();
    double squares_ = 0;
    double looks_ = 0;
};

} // namespace locus::uwb
