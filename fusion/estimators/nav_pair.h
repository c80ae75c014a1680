// Two navigation filters without an inertial sensor, which differ in how the target moves: steadily, with next to no
// acceleration, or as briskly as the settings allow. A tag that lies on a table or rides on a belt jitters less, and
// one that turns sharply is followed as before.
#pragma once

#include "fusion/estimators/nav_filter.h"
#include "fusion/filter/interacting.h"

namespace locus {

class NavPair {
  public:
    /// `site` outlives the pair.
    NavPair(const Site& site, const InertialEkfSettings& settings);

    /// `both`: or the brisk one goes on alone.
    Verdict update(const Measurement& measurement, bool both) noexcept;
    Verdict see(const AlignedPlace& place, const Measurement& odometry, bool both) noexcept;
    Estimate predict(Timestamp time) const noexcept;

    const NavFilter& brisk() const noexcept { return brisk_; }

  private:
    /// `tell` gives one filter what there is to hear.
    template <class Tell>
    Verdict hear(const Tell& tell, Timestamp time, bool both) noexcept;
    void interact(Timestamp time) noexcept;
    void learn(const Verdict& brisk, const Verdict& steady) noexcept;

    NavFilter brisk_, steady_;
    filter::ModelPair models_;
    bool is_pair_;
    bool paired_ = false; ///< the steady one knows what the brisk one knows
    Timestamp mixed_{};
};

/// Mean and covariance of the mixture of two estimates of one time.
Estimate mixed(const Estimate& a, const Estimate& b, double share_of_b);

} // namespace locus
