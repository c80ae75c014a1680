// A navigation track aided by whatever comes: ranges and range differences as every range filter takes them, and beside
// them inertial samples, heights, speeds, the feet that a camera sees (nav_filter_feet.cpp) and a SLAM's path
// (nav_filter_odometry.cpp).
#pragma once

#include "fusion/estimators/aligned_place.h"
#include "fusion/estimators/inertial_ekf_settings.h"
#include "fusion/estimators/nav_track.h"
#include "fusion/estimators/range_filter.h"
#include "fusion/filter/interacting.h"

namespace locus {

class NavFilter final : public RangeFilter<NavTrack> {
  public:
    /// `site` outlives the filter.
    NavFilter(const Site& site, const InertialEkfSettings& settings);

    Verdict update(const Measurement& measurement) noexcept override;
    /// `odometry`: the measurement that was aligned.
    Verdict see(const AlignedPlace& place, const Measurement& odometry) noexcept;
    std::unique_ptr<Estimator> clone() const override { return std::make_unique<NavFilter>(*this); }
    void copy_from(const Estimator& other) noexcept override { *this = static_cast<const NavFilter&>(other); }

    /// Takes over all that another one knows of the target; what the inertial sensor has taught stays.
    void restart_from(const NavFilter& other) noexcept;

    /// Takes over all but how the target moves.
    void go_with(const NavFilter& other) noexcept;
    /// Both go on from mixtures (filter/interacting.h); false: they do not know the same things.
    bool interact(NavFilter& second, const filter::ModelPair::Mixing& mixing) noexcept;
    /// Of innovations of ranges as they come, over what is expected.
    double innovation_spread() const noexcept { return robust_spread(); }

    using RangeFilter::forget_after;
    using RangeFilter::has_position;
    using RangeFilter::reset_count;
    using RangeFilter::unheard_s;

  private:
    Verdict take(const ImuSample& sample, Timestamp time) noexcept;
    void stand(double sigma_mps) noexcept;
    Verdict take(const Height& height) noexcept;
    Verdict take(const WheelSpeed& wheel) noexcept;
    Verdict take(const FootPoint& foot, Timestamp time) noexcept;
    void start_on_foot(const FootPoint& foot, Timestamp time) noexcept;
    Verdict see_feet(const FootPoint& foot, const Eigen::Vector2d& axis, double variance_m2,
                     filter::Gate& gate) noexcept;
    void stand_on_floor() noexcept;
    Verdict see_along(int axis, const AlignedPlace& place) noexcept;

    InertialEkfSettings settings_;
    filter::Gate height_gate_, speed_gate_;
    std::array<filter::Gate, 3> standstill_gates_;
    std::array<filter::Gate, 2> foot_gates_;
    filter::Gate floor_gate_;
    std::array<filter::Gate, 3> place_gates_;
    filter::RobustGain height_robust_, speed_robust_, standstill_robust_, foot_robust_, place_robust_;
    std::uint32_t places_ = 0; ///< of an aligned odometry, so far
    Timestamp stood_{};
};

} // namespace locus
