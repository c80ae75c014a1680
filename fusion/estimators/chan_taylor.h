// The position of each epoch by itself (paper 000, section 2.2), with the covariance that follows from it: what a
// recording is worth without any filter, and so the measure of all that filters add.
#pragma once

#include "fusion/estimators/epoch_estimator.h"

namespace locus {

struct ChanTaylorSettings : EpochEstimatorSettings {};

/// The last position, and a velocity of which only the size is known: zero, give or take the target's speed.
class LastFix {
  public:
    using Settings = ChanTaylorSettings;
    static constexpr auto reach = EpochGatherer::Reach::sliding;

    explicit LastFix(const Settings& settings) noexcept
        : speed_sigma_mps_(settings.speed_sigma_mps), axes_(settings.planar ? 2 : 3) {}

    void take(const Eigen::Vector3d& position_m, const Eigen::Matrix3d& covariance_m2, Timestamp time) noexcept;
    void write(Timestamp time, Estimate& estimate) const noexcept;

  private:
    double speed_sigma_mps_;
    int axes_;
    Eigen::Vector3d position_m_ = Eigen::Vector3d::Zero();
    Eigen::Matrix3d covariance_m2_ = Eigen::Matrix3d::Zero();
    Timestamp time_{};
};

inline constexpr EstimatorRow chan_taylor_row{
    "chan_taylor", "The position of each epoch by itself (Chan-Taylor), no filter: to compare with.",
    option_table<ChanTaylorSettings>(epoch_estimator_options<ChanTaylorSettings>), make_epoch_estimator<LastFix>};

} // namespace locus
