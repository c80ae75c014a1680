// Nine-state extended Kalman filter on UWB ranges and range differences (paper 001, eq. 1-11), with what recordings of
// real tags ask beyond the paper: an acceleration that dies away, the errors that anchors carry along as states, soft
// weights beside a gate that reopens, a start from nothing and a new start when the target is plainly elsewhere.
#pragma once

#include "fusion/estimators/estimator.h"
#include "fusion/estimators/range_expectation.h"
#include "fusion/estimators/range_reader.h"
#include "fusion/filter/gate.h"
#include "fusion/filter/robust_gain.h"
#include "fusion/filter/track_state.h"
#include "fusion/uwb/epoch_keeper.h"

#include <array>
#include <optional>
#include <vector>

namespace locus {

class RangeEkf final : public Estimator {
  public:
    /// `site` outlives the estimator.
    RangeEkf(const Site& site, const RangeEkfSettings& settings);

    Verdict update(const Measurement& measurement) noexcept override;
    Estimate predict(Timestamp time) const noexcept override;
    std::unique_ptr<Estimator> clone() const override { return std::make_unique<RangeEkf>(*this); }
    void copy_from(const Estimator& other) noexcept override { *this = static_cast<const RangeEkf&>(other); }

    /// For tests: the state as it was after the last update.
    const filter::TrackState& track() const noexcept { return track_; }

  private:
    Verdict take(const uwb::Sighting& sighting, Timestamp time) noexcept;
    Verdict start(Timestamp time) noexcept;
    Verdict weigh(const uwb::Sighting& sighting) noexcept;
    void count_refusal(bool refused, double dt_s) noexcept;
    void start_again_if_lost(Timestamp time) noexcept;
    void start_at(const uwb::Fix& fix, Timestamp time) noexcept;

    const Site* site_;
    RangeEkfSettings settings_;
    double gate_in_sigma_;
    double start_anew_cost_;

    RangeReader reader_;
    CarriedErrors errors_;
    filter::TrackState track_;
    uwb::EpochKeeper epoch_;
    filter::RobustGain robust_;
    std::vector<filter::Gate> gates_;                     ///< by anchor; of a difference, anchor_b's
    std::array<std::optional<Timestamp>, 2> kind_used_{}; ///< Range, RangeDifference
    Timestamp time_{};                                    ///< of the state
    Timestamp used_time_{};                               ///< of the last measurement used
    double refused_share_ = 0;
    std::uint32_t reset_count_ = 0;
    Missing missing_ = Missing::measurements;
};

std::unique_ptr<Estimator> make_range_ekf(const Site& site, const void* settings);

inline constexpr EstimatorRow range_ekf_row{
    "range_ekf", "Position, velocity and acceleration from UWB ranges and range differences.",
    option_table<RangeEkfSettings>(range_ekf_options), make_range_ekf};

} // namespace locus
