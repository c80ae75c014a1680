// Particle refinement of paper 003 section 5: a cloud of places for one radio, moved as in Condensation and weighed by
// what is known of it: its radio fix alone (eq. 7), the fix and the place of the person seen (eq. 8), or the fix by the
// calibrated map and the strengths of other radios whose places are known (eq. 9). The paper's weights fall by e in
// each metre, as if a camera knew a place no better than a radio; here each distance counts in units of what it is
// uncertain by.
#pragma once

#include "fusion/filter/particles.h"

#include <Eigen/Core>

#include <span>

namespace locus::radio {

struct RefinementSettings {
    double seen_share = 0.9;    ///< alpha_v of eq. 8
    double radio_share = 0.5;   ///< alpha_r of eq. 9
    double seen_sigma_m = 0.15; ///< of a foot point (docs/cameras.md)
    double fix_sigma_m = 2;     ///< of a radio fix in a room with a map of two metres' spacing
    double speed_mps = 1;       ///< at which the places wander, each axis
    int particles = 1000;
    std::uint64_t seed = 1;
};

/// A seen radio's place, and how far off its strength says it is.
struct SeenPeer {
    Eigen::Vector2d position_site_m{0, 0};
    double distance_m = 0;
    double sigma_m = 1; ///< of that distance: with strengths it grows as the distance does
};

class Refinement {
  public:
    explicit Refinement(const RefinementSettings& settings);

    /// Moves the cloud on; the first time it is put about the fix.
    void move(double dt_s, const Eigen::Vector2d& fix_m) noexcept;
    void weigh(const Eigen::Vector2d& fix_m) noexcept;                                     ///< eq. 7
    void weigh_seen(const Eigen::Vector2d& fix_m, const Eigen::Vector2d& seen_m) noexcept; ///< eq. 8
    void weigh_unseen(const Eigen::Vector2d& fix_m,
                      std::span<const SeenPeer> peers) noexcept; ///< eq. 9; no peer: eq. 7

    Eigen::Vector2d position_site_m() const noexcept { return cloud_.mean().head<2>(); }

  private:
    void settle() noexcept;

    RefinementSettings settings_;
    filter::Particles cloud_;
    bool started_ = false;
};

} // namespace locus::radio
