// The newest inertial sample, held until the next one comes. Measurements fall between samples, so the state is carried
// on with what is held; when the next sample comes, the half step by which holding lags behind the trapezoid rule is
// made good at once.
#pragma once

#include "fusion/measurement.h"

#include <Eigen/Core>

#include <optional>

namespace locus::inertial {

struct Rates {
    Eigen::Vector3d specific_force_mps2{0, 0, 0}; ///< body frame
    Eigen::Vector3d angular_rate_radps{0, 0, 0};  ///< body frame
};

class HeldImu {
  public:
    /// Samples further apart than this are not joined by a straight line, and one older than this says nothing.
    static constexpr double max_gap_s = 0.2;

    /// What the sample differs by from the one held, and for how long that was held; none after a gap.
    struct Lag {
        Rates difference;
        double held_s = 0;
    };
    std::optional<Lag> take(const ImuSample& sample, Timestamp time) noexcept;

    const Rates& rates() const noexcept { return rates_; }
    bool is_fresh(Timestamp time) const noexcept { return taken_ && to_s(time - *taken_) <= max_gap_s; }

  private:
    Rates rates_;
    std::optional<Timestamp> taken_;
};

} // namespace locus::inertial
