// A sensor's radio: what it measures of a target, with noise, shadows and losses. Seeded: the same calls give the same
// measurements.
#pragma once

#include "fusion/measurement.h"
#include "tools/simulate/world.h"

#include <random>
#include <vector>

namespace locus::simulate {

/// What one sensor measured of one target at one time.
struct Epoch {
    Timestamp arrival{}; ///< when the host receives it
    double device_s = 0; ///< by the device's own clock
    Address tag = no_address;
    unsigned sequence = 0; ///< of this target
    std::vector<Observation> observations;
};

class Receiver {
  public:
    /// `number` is the sensor's place in the scenario: each has random numbers of its own, so that one more sensor does
    /// not change what the others measure.
    Receiver(const Scenario& scenario, Radio radio, unsigned number);

    /// `mover` is a place in scenario.movers; the target is at `position_site_m`.
    std::vector<Observation> measure(std::size_t mover, const Eigen::Vector3d& position_site_m);

  private:
    /// An anchor and a target. A shadow's bias stays the same as long as the shadow lasts.
    struct Link {
        bool shadowed = false;
        double bias_share = 0;
    };
    struct Heard {
        Address anchor;
        double distance_m; ///< with the walls' bias, without noise
    };

    const Scenario& scenario_;
    Radio radio_;
    std::mt19937_64 random_;
    std::vector<Link> links_; ///< anchors of the first mover, of the second, ...

    double uniform() { return std::uniform_real_distribution<double>()(random_); }
    double noise_m() { return radio_.sigma_m * std::normal_distribution<double>()(random_); }
    std::vector<Heard> hear(std::size_t mover, const Eigen::Vector3d& position_site_m);
    Range range(Address tag, const Heard& heard);
    RangeDifference difference(Address tag, const Heard& a, const Heard& b);
};

} // namespace locus::simulate
