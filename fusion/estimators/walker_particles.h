// People on a floor, by particles (paper 004 eq. 4-7 and its three steps: predict, weigh, resample). Steps of a worn
// inertial unit move the cloud, a wandering velocity does where there is none; ranges, range differences and ranges
// between people weigh it, each with a chance of a blocked path; walls stop it. It stays right where a Kalman filter
// cannot: while the heading is not known yet, and where a wall leaves two rooms possible.
#pragma once

#include "fusion/estimators/estimator.h"
#include "fusion/estimators/range_reader.h"
#include "fusion/estimators/used_kinds.h"
#include "fusion/estimators/walker_particles_settings.h"
#include "fusion/estimators/walking_cloud.h"
#include "fusion/filter/anchor_gates.h"
#include "fusion/filter/covariance_intersection.h"
#include "fusion/uwb/epoch_keeper.h"

#include <optional>
#include <vector>

namespace locus {

class WalkerParticles final : public Estimator {
  public:
    /// `site` outlives the estimator.
    WalkerParticles(const Site& site, const WalkerParticlesSettings& settings);

    Verdict update(const Measurement& measurement) noexcept override;
    Estimate predict(Timestamp time) const noexcept override;
    std::unique_ptr<Estimator> clone() const override { return std::make_unique<WalkerParticles>(*this); }
    void copy_from(const Estimator& other) noexcept override;

    /// For tests: the cloud as it was after the last update.
    const filter::Particles& cloud() const noexcept { return walk_.particles(); }

  private:
    struct Expected {
        double innovation_m = 0;
        Eigen::Vector2d gradient{0, 0};
        double climb = 0; ///< derivative by the tag's height
    };

    /// All but the cloud and its gait.
    struct State {
        filter::AnchorGates gates; ///< of a difference, anchor_b's
        std::vector<std::optional<Timestamp>> heard;
        UsedKinds used;
        uwb::EpochKeeper epoch;
        std::uint32_t reset_count = 0;
        Missing missing = Missing::measurements;
    };

    Verdict hear(const Measurement& measurement) noexcept;
    Exclusion hear(const ImuSample& sample, Timestamp time) noexcept;
    Verdict hear(const PeerRange& range, Timestamp time) noexcept;
    filter::Intersection share_with(const Eigen::Vector2d& direction, double state_variance,
                                    double variance_m2) const noexcept;
    Verdict take(const uwb::Sighting& sighting, Timestamp time) noexcept;
    Verdict start(Timestamp time) noexcept;
    void start_at(const uwb::Fix& fix, Timestamp time) noexcept;

    Expected expect(const uwb::Sighting& sighting) const noexcept;
    double variance_m2(const uwb::Sighting& sighting, double climb, Timestamp time) noexcept;
    Verdict weigh(const uwb::Sighting& sighting, Timestamp time) noexcept;
    filter::ParticleNoise noise(double variance_m2) const noexcept;
    bool settle() noexcept;
    void start_again_if_lost(Timestamp time) noexcept;

    filter::Particles& particles() noexcept { return walk_.particles(); }

    const Site* site_;
    WalkerParticlesSettings settings_;
    double gate_in_sigma_;
    RangeReader reader_;
    WalkingCloud walk_;
    State state_;
};

std::unique_ptr<Estimator> make_walker_particles(const Site& site, const void* settings);

inline constexpr EstimatorRow walker_particles_row{
    "walker_particles", "People on a floor: steps of a worn inertial unit, ranges, ranges between people, walls.",
    option_table<WalkerParticlesSettings>(walker_particles_options), make_walker_particles};

} // namespace locus
