// Nine-state extended Kalman filter on UWB ranges and range differences (paper 001, eq. 1-11), with what recordings of
// real tags ask beyond the paper: an acceleration that dies away, and all that range_filter.h adds.
#pragma once

#include "fusion/estimators/range_filter.h"
#include "fusion/filter/track_state.h"

namespace locus {

class RangeEkf final : public RangeFilter<filter::TrackState> {
  public:
    /// `site` outlives the estimator.
    RangeEkf(const Site& site, const RangeEkfSettings& settings);

    std::unique_ptr<Estimator> clone() const override { return std::make_unique<RangeEkf>(*this); }
    void copy_from(const Estimator& other) noexcept override { *this = static_cast<const RangeEkf&>(other); }
};

/// How the target moves by these settings.
filter::TrackModel track_model(const RangeEkfSettings& settings);

std::unique_ptr<Estimator> make_range_ekf(const Site& site, const void* settings);

inline constexpr EstimatorRow range_ekf_row{
    "range_ekf", "Position, velocity and acceleration from UWB ranges and range differences.",
    option_table<RangeEkfSettings>(range_ekf_options), make_range_ekf};

} // namespace locus
