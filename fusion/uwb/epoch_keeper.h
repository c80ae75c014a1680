// What the anchors have lately said of one target: the newest range of each and the newest difference of each pair.
// Tags are heard one anchor at a time; a position without a prior needs an epoch, and this gathers one. It also leaves
// the odd one out, because an epoch with one blocked path in it would start a filter in the wrong room.
#pragma once

#include "fusion/time.h"
#include "fusion/uwb/sighting.h"
#include "fusion/uwb/solve.h"

#include <Eigen/Core>

#include <array>

namespace locus::uwb {

struct EpochSettings {
    double window_s = 0.5;
    double speed_mps = 1;            ///< how far the target may have gone since a sighting, per second
    double held_range_sigma_m = 0.3; ///< of the errors that ranges carry along, beside their noise
    double held_difference_sigma_m = 0.3;
    double false_alarm = 1e-3; ///< chance that a good epoch is called one that does not agree
    SolveSettings solve;
};

class EpochKeeper {
  public:
    /// `site` outlives the keeper. Throws std::domain_error when false_alarm is not within 0..1.
    EpochKeeper(const Site& site, const EpochSettings& settings);

    void keep(const Sighting& sighting, Timestamp time) noexcept;

    /// The position that the window before `now` agrees on: from ranges where they are enough, else from differences.
    struct Answer {
        Fix fix;
        bool agrees = false;      ///< whether the sightings, but for a quarter of them at most, agree on it
        double cost_of_other = 0; ///< of the position asked about, summed over the sightings that agree
    };
    Answer solve(Timestamp now, const Eigen::Vector3d& other_site_m) const noexcept;
    /// The same from what was heard at `since` or later.
    Answer solve_since(Timestamp since, Timestamp now, const Eigen::Vector3d& other_site_m) const noexcept;

    /// Whether the anchor, or the pair, of this sighting was heard at `since` or later.
    bool heard(const Sighting& sighting, Timestamp since) const noexcept;

  private:
    struct Kept {
        Sighting sighting;
        Timestamp time{};
    };
    struct Chosen {
        std::array<Kept, max_observations> kept;
        std::size_t size = 0;
    };
    const Kept* find(const Sighting& sighting) const noexcept;
    Chosen choose(bool ranges, Timestamp since) const noexcept;
    double sigma_m(const Kept& kept, Timestamp now) const noexcept;
    double residual_in_sigma(const Kept& kept, const Eigen::Vector3d& position, Timestamp now) const noexcept;
    Fix solve_once(const Chosen& chosen, bool ranges, Timestamp now) const noexcept;
    Answer solve_kind(bool ranges, Timestamp since, Timestamp now, const Eigen::Vector3d& other_site_m) const noexcept;
    bool agrees(const Fix& fix) const noexcept;

    const Site* site_;
    EpochSettings settings_;
    double quantile_in_sigma_ = 3;
    std::array<Kept, max_observations> kept_{};
    std::size_t size_ = 0;
};

} // namespace locus::uwb
