// Somebody on a floor who carries a radio (paper 003 section 5, with the likelihood of the strengths themselves in
// place of the distance to a fix, eq. 7): steps of a worn inertial unit or a wandering velocity move the cloud, signal
// strengths weigh it by a map or, where there is none, by the path loss from the anchors. Beacons that ought to be
// heard and are not count as weak. The first position, and the next where the cloud has lost its way, is where the
// readings of a scan put it. Whom a camera has identified with it is where his feet are seen (paper 003 eq. 6).
#pragma once

#include "fusion/estimators/estimator.h"
#include "fusion/estimators/radio_particles_settings.h"
#include "fusion/estimators/used_kinds.h"
#include "fusion/estimators/walking_cloud.h"
#include "fusion/radio/floor_posterior.h"
#include "fusion/radio/grid_in_use.h"
#include "fusion/radio/path_loss.h"
#include "fusion/radio/reading_noise.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <vector>

namespace locus {

class RadioParticles final : public Estimator {
  public:
    /// `site` outlives the estimator. With a map of hundreds of points this takes seconds.
    RadioParticles(const Site& site, const RadioParticlesSettings& settings);

    Verdict update(const Measurement& measurement) noexcept override;
    Estimate predict(Timestamp time) const noexcept override;
    std::unique_ptr<Estimator> clone() const override { return std::make_unique<RadioParticles>(*this); }
    void copy_from(const Estimator& other) noexcept override;

    /// For tests: the cloud as it was after the last update.
    const filter::Particles& cloud() const noexcept { return walk_.particles(); }

  private:
    /// What is known of a beacon of the grid.
    struct Beacon {
        std::optional<Timestamp> heard;
        float sum_dbm = 0; ///< of the readings of this scan
        std::uint32_t count = 0;
        float offset_db = 0; ///< stronger than the grid says
        float offset_variance_db2 = 0;

        float mean_dbm() const noexcept { return sum_dbm / static_cast<float>(count); }
    };

    /// Another's tag that is heard.
    struct Peer {
        Address tag = no_address;
        std::optional<Timestamp> heard;
    };
    static constexpr std::size_t max_peers = 16; ///< whose times are remembered; whoever was heard longest ago goes

    /// Feet in a row that were too far off.
    struct Refused {
        Timestamp first, last;
    };

    struct State {
        std::vector<Beacon> beacons;
        std::array<Peer, max_peers> peers;
        UsedKinds used;
        std::optional<Timestamp> scan_begin;
        int odd = 0, heard = 0; ///< readings of this scan that hardly fit, and all
        double doubt = 0;       ///< logarithm of how much likelier the floor as a whole makes them than the cloud
        std::uint32_t reset_count = 0;
        std::optional<Timestamp> believed_feet; ///< the last that were not refused
        std::optional<Refused> refused_feet;
        Missing missing = Missing::measurements;
    };

    struct Outlook {
        float mean_dbm = 0;
        float variance_db2 = 1; ///< of a reading, as the cloud and the grid foresee it
        Eigen::Vector2d gradient_dbpm{0, 0};
    };

    Exclusion hear(const ImuSample& sample, Timestamp time) noexcept;
    Verdict hear(const SignalStrength& strength, Timestamp time) noexcept;
    Verdict hear_peer(const SignalStrength& strength, Timestamp time) noexcept;
    float new_share_of_peer(Address tag, Timestamp time) noexcept;
    Verdict see(const FootPoint& foot, Timestamp time) noexcept;
    Verdict judge_feet(const FootPoint& foot, const Eigen::Matrix2d& covariance_m2) const noexcept;
    bool is_seen(Timestamp time) const noexcept;
    bool is_patient(Timestamp time) noexcept;
    void stand_on(const FootPoint& foot, const Eigen::Matrix2d& covariance_m2, Timestamp time) noexcept;
    void weigh_feet(const FootPoint& foot, const Eigen::Matrix2d& covariance_m2) noexcept;

    Outlook foresee(std::size_t beacon) const noexcept;
    void learn_offset(Beacon& beacon, const Outlook& outlook, float innovation_db) noexcept;
    void announce(Beacon& beacon, const SignalStrength& strength) const noexcept;
    void weigh(std::size_t beacon, float rssi_dbm, float share) noexcept;
    float scan_share() const noexcept;

    void end_scan(Timestamp time) noexcept;
    void weigh_silence() noexcept;
    void gather() noexcept;
    void start(Timestamp time) noexcept;
    void start_again_if_lost(Timestamp time) noexcept;
    void put_where_radios_say(Timestamp time) noexcept;

    const radio::StrengthGrid& grid() const noexcept { return grid_->grid(); }

    const Site* site_;
    RadioParticlesSettings settings_;
    double doubt_limit_;
    double feet_gate_in_sigma_;
    radio::ReadingNoise noise_;
    radio::PathLoss peer_loss_;                    ///< between two tags
    std::shared_ptr<const radio::GridInUse> grid_; ///< the same for all clones
    radio::FloorPosterior posterior_;              ///< room for start()
    std::vector<radio::IndexedReading> readings_;  ///< of a scan; room
    WalkingCloud walk_;
    State state_;
};

/// What is heard or seen faster than its error changes says the same again: how much of it is new.
inline float new_share(const std::optional<Timestamp>& last, Timestamp time, double held_s) noexcept {
    if (!last.has_value() || held_s <= 0) return 1;
    return static_cast<float>(std::min(1.0, to_s(time - last.value()) / held_s));
}

std::unique_ptr<Estimator> make_radio_particles(const Site& site, const void* settings);

inline constexpr EstimatorRow radio_particles_row{
    "radio_particles", "People on a floor by signal strength: a radio map or the anchors' path loss, steps, feet.",
    option_table<RadioParticlesSettings>(radio_particles_options), make_radio_particles};

} // namespace locus
