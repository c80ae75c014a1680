// Anchors whose crystals run as they like, sync packets among them and tags that blink: what the proofs of the clock
// synchronisation run on. Time goes on in steps of a millisecond; every stamp is a whole number of 15.65 ps ticks of a
// counter that wraps; every message reaches the host late by a few milliseconds, by as much as chance has it. Seeded.
#pragma once

#include "fusion/geometry/vector.h"
#include "fusion/uwb/ticks.h"

#include <cmath>
#include <functional>
#include <random>
#include <vector>

namespace locus::clock_test {

inline constexpr double step_s = 1e-3;

/// A counter whose rate is off by `rate` and changes by `drift_per_s`, which wanders about its own mean.
struct Crystal {
    long double ticks = 0; ///< at the present step
    double rate = 0;
    double drift_per_s = 0;
    double mean_drift_per_s = 0;
    double wander_per_s = 0; ///< standard deviation of the drift about its mean
    double wander_time_s = 60;

    template <class Random>
    void step(Random& random) {
        const double away = drift_per_s - mean_drift_per_s, keep = std::exp(-step_s / wander_time_s);
        const double fresh = wander_per_s * std::sqrt(1 - keep * keep) * std::normal_distribution<double>()(random);
        ticks += static_cast<long double>(step_s / uwb::tick_s) *
                 (1 + static_cast<long double>(rate + drift_per_s * step_s / 2));
        rate += drift_per_s * step_s;
        drift_per_s = mean_drift_per_s + keep * away + fresh;
    }

    /// `later_s` after the present step; a millisecond or so.
    long double at(double later_s) const {
        return ticks + static_cast<long double>(later_s / uwb::tick_s) *
                           (1 + static_cast<long double>(rate + drift_per_s * later_s / 2));
    }
};

struct Air {
    double sync_interval_s = 0.15;
    double sync_loss = 0;
    double arrival_sigma_s = 150e-12;
    double blink_interval_s = 0.02;
    double blink_loss = 0;
    double most_delay_s = 0.004; ///< from the radio to the host
    int clock_bits = 40;
    std::size_t deaf = 1000; ///< an anchor that hears no blinks
};

/// A message as it reaches the host, and what of it only the simulation knows.
struct Message {
    double host_s = 0;
    Measurement measurement;
};

class SimulatedAnchors {
  public:
    std::vector<Crystal> crystals;                          ///< by anchor
    std::vector<std::pair<std::size_t, std::size_t>> hears; ///< transmitter, receiver
    std::function<Eigen::Vector3d(double time_s)> tag_position;
    std::function<void(const Message&)> send;
    Site site;
    Air air;

    explicit SimulatedAnchors(unsigned seed) : random_(seed) {}

    /// Anchors at these places, with addresses 0, 1, 2 ..., crystals up to 20 ppm off, counters anywhere.
    void place(const std::vector<Vec3>& places) {
        for (const Vec3& place : places) {
            site.anchors.push_back({"", address(site.anchors.size()), place});
            crystals.push_back({uniform() * 1e12, (2 * uniform() - 1) * 20e-6});
        }
    }

    void everyone_hears(std::size_t transmitter) {
        for (std::size_t i = 0; i < site.anchors.size(); ++i)
            if (i != transmitter) hears.emplace_back(transmitter, i);
    }

    double time_s() const { return static_cast<double>(steps_) * step_s; }

    /// Noise that arrival stamps of the last blink at anchor b had, less that of anchor a: what perfect clocks would
    /// leave.
    double noise_between_m(std::size_t a, std::size_t b, std::uint32_t sequence) const {
        const auto& noises = noises_s_[sequence % noises_s_.size()];
        return (noises[b] - noises[a]) * uwb::speed_of_light_mps;
    }
    Eigen::Vector3d position_of_blink(std::uint32_t sequence) const { return positions_[sequence % positions_.size()]; }

    void step() {
        for (auto& crystal : crystals) crystal.step(random_);
        ++steps_;
        for (std::size_t i = 0; i < crystals.size(); ++i)
            if (is_due(air.sync_interval_s, 0.003 * static_cast<double>(i))) sync(i);
        if (is_due(air.blink_interval_s, 0.0017)) blink();
    }

  private:
    std::mt19937_64 random_;
    std::int64_t steps_ = 0;
    std::uint32_t blinks_ = 0, syncs_ = 0, sent_ = 0;
    std::array<std::vector<double>, 256> noises_s_;
    std::array<Eigen::Vector3d, 256> positions_;

    double uniform() { return std::uniform_real_distribution<double>()(random_); }
    double noise_s() { return air.arrival_sigma_s * std::normal_distribution<double>()(random_); }
    Eigen::Vector3d place_of(std::size_t anchor) const { return vector(site.anchors[anchor].position_site_m); }

    bool is_due(double interval_s, double offset_s) const {
        const auto every = std::llround(interval_s / step_s);
        return every > 0 && (steps_ - std::llround(offset_s / step_s)) % every == 0;
    }
    std::uint64_t stamp(long double ticks) const {
        return static_cast<std::uint64_t>(std::llround(ticks)) & ((std::uint64_t{1} << air.clock_bits) - 1);
    }

    void deliver(const Observation& observation) {
        Measurement measurement{timestamp_from_s(100 + time_s() + uniform() * air.most_delay_s), sent_++, 0,
                                observation};
        send({to_s(measurement.time), measurement});
    }

    void sync(std::size_t transmitter) {
        bool sent = false;
        const double jitter_s = uniform() * 0.5e-3; // within the step, so that stamps have every fraction
        for (const auto& [from, to] : hears) {
            if (from != transmitter) continue;
            sent = true;
            if (uniform() < air.sync_loss) continue;
            const double flight_s = (place_of(from) - place_of(to)).norm() / uwb::speed_of_light_mps;
            // A packet leaves when the transmitter's counter has a whole number.
            const long double leaves = crystals[from].at(jitter_s);
            const double until_whole_s = static_cast<double>(std::ceil(leaves) - leaves) * uwb::tick_s;
            deliver(ClockSync{site.anchors[from].address, site.anchors[to].address, stamp(std::ceil(leaves)),
                              stamp(crystals[to].at(jitter_s + until_whole_s + flight_s + noise_s())), syncs_ & 0xFF});
        }
        if (sent) ++syncs_;
    }

    void blink() {
        const std::uint32_t sequence = blinks_++ & 0xFF;
        const Eigen::Vector3d position = positions_[sequence] = tag_position(time_s());
        const double jitter_s = uniform() * 0.5e-3;
        auto& noises = noises_s_[sequence];
        noises.assign(crystals.size(), 0);
        for (std::size_t i = 0; i < crystals.size(); ++i) {
            const double flight_s = (place_of(i) - position).norm() / uwb::speed_of_light_mps;
            const long double true_ticks = crystals[i].at(jitter_s + flight_s);
            const std::uint64_t heard = stamp(crystals[i].at(jitter_s + flight_s + noise_s()));
            const uwb::WrappingClock clock{air.clock_bits};
            const long double whole = std::floor(true_ticks);
            noises[i] =
                static_cast<double>(clock.between(heard, static_cast<std::uint64_t>(whole)) - (true_ticks - whole)) *
                uwb::tick_s;
            if (uniform() < air.blink_loss || i == air.deaf) continue;
            deliver(Arrival{site.anchors[i].address, address(9), heard, sequence});
        }
    }
};

} // namespace locus::clock_test
