// The vehicles' estimator: GNSS and an inertial sensor, loosely (fixes) or tightly (each satellite's range and rate, of
// use from the first satellite on), with wheels, barometer, the heading of two antennas, standstill and UWB ranges
// beside them (paper 002; Groves 2013, chapters 14 and 15). The state is in ECEF, the pose in the site's frame, which
// must have an origin.
#pragma once

#include "fusion/estimators/estimator.h"
#include "fusion/estimators/gnss_ins_carriers.h"
#include "fusion/estimators/gnss_ins_observations.h"
#include "fusion/estimators/gnss_start.h"
#include "fusion/filter/adaptive_noise.h"
#include "fusion/filter/gate.h"

#include <memory>

namespace locus {

class GnssIns final : public Estimator {
  public:
    /// `site` outlives the estimator.
    GnssIns(const Site& site, const GnssInsSettings& settings);

    Verdict update(const Measurement& measurement) noexcept override;
    Estimate predict(Timestamp time) const noexcept override;
    std::unique_ptr<Estimator> clone() const override { return std::make_unique<GnssIns>(*this); }
    void copy_from(const Estimator& other) noexcept override { *this = static_cast<const GnssIns&>(other); }

    /// For tests.
    const GnssInsTrack& track() const noexcept { return track_; }
    GnssInsTrack& track() noexcept { return track_; }

  private:
    /// What shares a robust weight and a learnt noise.
    enum class Aid : std::uint8_t {
        code,
        rate,
        fix,
        fix_velocity,
        wheel,
        yaw,
        slip,
        standing,
        standing_rate,
        pressure,
        range,
        carrier,
        heading,
        count_
    };
    /// Share of refused observations from which on the filter may be lost.
    static constexpr double lost_share = 0.9;
    static constexpr std::size_t aids = static_cast<std::size_t>(Aid::count_);

    Verdict take(const ImuSample& sample, Timestamp time) noexcept;
    Verdict take(const SatelliteRange& range, Timestamp time) noexcept;
    Verdict take(const GnssFix& fix, Timestamp time) noexcept;
    Verdict take(const Range& range, Timestamp time) noexcept;
    Verdict take(const WheelSpeed& wheel, Timestamp time) noexcept;
    Verdict take(const Pressure& pressure, Timestamp time) noexcept;
    Verdict take(const Heading& heading, Timestamp time) noexcept;
    template <class Other>
    Verdict take(const Other&, Timestamp) noexcept {
        return {Exclusion::unsupported_kind};
    }

    Exclusion refusal(const SatelliteRange& range) const noexcept;
    Verdict take_rate(const SatelliteRange& range, filter::Gate& gate) noexcept;
    bool clock_jumped(const SatelliteRange& range, const GnssInsScalar& code) noexcept;
    CarrierUse hear_carrier(const SatelliteRange& range, Timestamp time) noexcept;
    using CarrierEquations = std::array<gnss::CarrierEquation, GnssInsCarriers::room>;
    using CarrierOwners = std::array<gnss::CarrierSight*, GnssInsCarriers::room>;
    void finish_epoch() noexcept;
    void use_carriers() noexcept;
    std::size_t changes(CarrierEquations& equations, CarrierOwners& whose) noexcept;
    bool take_change(const gnss::CarrierSight& now) noexcept;
    Verdict take_fix(const GnssFix& fix) noexcept;
    bool is_wrong_baseline(const Heading& heading) const noexcept;
    bool begin_inertial_towards(const Heading& heading) noexcept;
    bool height_is_off(const GnssFix& fix) noexcept;
    void stand() noexcept;
    void hold_to_the_road() noexcept;
    bool stands_by_wheel(Timestamp time) const noexcept;

    Verdict start(const GnssInsStart& start, Timestamp time) noexcept;
    Verdict start_at(const GnssFix& fix, Timestamp time) noexcept;
    void move_to(Timestamp time) noexcept;
    bool tells_of_a_manoeuvre(Aid aid) const noexcept;
    Verdict weigh(Aid aid, const GnssInsScalar& scalar, filter::Gate& gate) noexcept;
    /// `memory`: observations of this kind over which the share of refused ones is taken.
    void note(const Verdict& verdict, Timestamp time, double memory) noexcept;
    void start_again_if_lost(Timestamp time) noexcept;
    Estimate prospect(Timestamp time) const noexcept;
    void report(const GnssInsTrack& track, Estimate& estimate) const noexcept;

    const GnssInsSettings& settings() const noexcept { return observations_->settings(); }
    static bool is_due(Timestamp& last, Timestamp time) noexcept;

    const Site* site_;
    std::shared_ptr<const GnssInsObservations> observations_; ///< shared by all copies: it never changes
    double gate_in_sigma_, consistency_quantile_;
    GnssInsTrack track_;
    GnssStart start_;
    GnssInsCarriers carriers_;
    std::array<filter::RobustGain, aids> robust_;
    std::array<filter::AdaptiveNoise, aids> noise_{};
    std::array<filter::Gate, 512> code_gates_{}, rate_gates_{}; ///< by satellite
    std::array<filter::Gate, 32> anchor_gates_{};
    std::array<std::array<filter::Gate, 3>, aids> gates_{}; ///< of all else, by axis
    std::array<Timestamp, std::variant_size_v<Observation>> kind_used_{};
    Timestamp time_{};      ///< of the state
    Timestamp used_time_{}; ///< of the last GNSS or range used
    Timestamp satellites_heard_{}, stood_{}, held_to_road_{}, wheel_used_{}, wheel_heard_{};
    double wheel_mps_ = 0;
    Pressure pressure_{};
    Timestamp pressure_heard_{};
    double clock_jump_m_ = 0; ///< that one satellite showed; a second one confirms it
    std::uint8_t clock_jump_by_ = 0;
    double refused_share_ = 0;
    bool started_ = false;
    std::uint32_t reset_count_ = 0;
};

std::unique_ptr<Estimator> make_gnss_ins(const Site& site, const void* settings);

inline constexpr EstimatorRow gnss_ins_row{
    "gnss_ins",
    "Vehicles: satellites or fixes with an inertial sensor, wheels, barometer, the heading of two antennas and UWB "
    "ranges; needs site.origin.",
    option_table<GnssInsSettings>(gnss_ins_options), make_gnss_ins, true};

} // namespace locus
