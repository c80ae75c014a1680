// What every filter on UWB ranges and range differences has in common, whatever its idea of motion: a start from
// nothing, soft weights beside a gate that reopens, the errors that anchors carry along as states, and a new start when
// the target is plainly elsewhere. `Track` says how the target moves: filter::TrackState, NavTrack.
#pragma once

#include "fusion/estimators/estimator.h"
#include "fusion/estimators/range_ekf_settings.h"
#include "fusion/estimators/range_expectation.h"
#include "fusion/estimators/range_reader.h"
#include "fusion/estimators/used_kinds.h"
#include "fusion/filter/anchor_gates.h"
#include "fusion/filter/robust_gain.h"
#include "fusion/uwb/epoch_keeper.h"

namespace locus {

template <class Track>
class RangeFilter : public Estimator {
  public:
    Verdict update(const Measurement& measurement) noexcept override;
    Estimate predict(Timestamp time) const noexcept override;

    /// For tests: the state as it was after the last update.
    const Track& track() const noexcept { return track_; }

  protected:
    /// `site` outlives the filter.
    RangeFilter(const Site& site, const RangeEkfSettings& settings, Track track);

    bool has_position() const noexcept { return missing_ == Missing::nothing; }
    /// A filter that keeps its way without ranges may wait longer than the settings say.
    void forget_after(double seconds) noexcept { forget_after_s_ = seconds; }
    double forget_after_s() const noexcept { return forget_after_s_; }

    std::uint32_t reset_count() const noexcept { return reset_count_; }
    /// Since the last range or range difference that was used; only where there is a position.
    double unheard_s(Timestamp time) const noexcept { return to_s(time - used_time_); }

    double robust_spread() const noexcept { return robust_.spread(); }

    /// Carries the state to `time`, at or after its own.
    void move_to(Timestamp time) noexcept;

    /// Takes one number into the state if it passes the gate.
    struct Scalar {
        double innovation = 0;
        typename Track::Vector jacobian; ///< of the prediction by the state
        double variance = 0;
    };
    Verdict weigh(const Scalar& scalar, filter::Gate& gate, filter::RobustGain& robust) noexcept;

    /// To be told of every observation that was taken in.
    void note_use(const Observation& observation, Timestamp time) noexcept { used_.note(observation, time); }
    /// And of those that tell where the target is.
    void note_place(Timestamp time) noexcept { used_time_ = time; }

    /// At rest at a place that something else than ranges found.
    void start_at(const Eigen::Vector3d& position_site_m, const Eigen::Matrix3d& covariance_m2,
                  Timestamp time) noexcept;

    Track track_;

  private:
    Verdict take(const uwb::Sighting& sighting, const Measurement& measurement) noexcept;
    Verdict start(Timestamp time) noexcept;
    void start_again_if_lost(Timestamp time) noexcept;

    const Site* site_;
    RangeEkfSettings settings_;
    double forget_after_s_;
    double gate_in_sigma_;
    double start_anew_cost_;

    RangeReader reader_;
    CarriedErrors errors_;
    uwb::EpochKeeper epoch_;
    filter::RobustGain robust_;
    filter::AnchorGates gates_; ///< of a difference, anchor_b's
    UsedKinds used_;
    Timestamp time_{};      ///< of the state
    Timestamp used_time_{}; ///< of the last sighting used
    std::uint32_t reset_count_ = 0;
    Missing missing_ = Missing::measurements;
};

} // namespace locus
