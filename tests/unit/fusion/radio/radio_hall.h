// A hall with beacons and somebody in it who is followed by radio_particles.
#pragma once

#include "fusion/estimators/radio_particles.h"
#include "tests/unit/fusion/inertial/simulated_walker.h"
#include "tests/unit/fusion/radio/simulated_radios.h"

#include <cmath>
#include <memory>

namespace locus::test {

/// Somebody who walks to and fro in a hall of 20 m x 12 m with six beacons that are heard twice a second.
struct RadioHall {
    explicit RadioHall(bool with_map = true, unsigned seed = 5, bool worn_unit = true,
                       SimulatedRadios own = SimulatedRadios(hall_beacons(), 8))
        : radios(std::move(own)), settings(with_map ? mapped() : RadioParticlesSettings{}), filter(site(), settings),
          walker({}, seed), unit(worn_unit) {
        walker.place({5, 6}, 0.3);
    }
    /// By a map that need not be of these radios.
    RadioHall(const radio::RadioMap& map, unsigned seed, SimulatedRadios own)
        : radios(std::move(own)), settings(by(map)), filter(site(), settings), walker({}, seed), unit(false) {
        walker.place({5, 6}, 0.3);
    }

    const Site& site() {
        if (site_.anchors.empty())
            for (const auto& beacon : hall_beacons())
                site_.anchors.push_back({"", address(100 + site_.anchors.size()), {beacon.x(), beacon.y(), 2.7}});
        return site_;
    }
    RadioParticlesSettings mapped() { return by(radios.survey(20, 12, 2)); }
    static RadioParticlesSettings by(const radio::RadioMap& map) {
        RadioParticlesSettings by_map;
        by_map.radio_map = std::make_shared<const radio::RadioMap>(map);
        return by_map;
    }

    void walk(double seconds, bool heard = true) {
        for (const double end_s = walker.time_s() + seconds; walker.time_s() < end_s;) {
            const bool leaves = walker.position_m().x() < 3 || walker.position_m().x() > 17 ||
                                walker.position_m().y() < 3 || walker.position_m().y() > 9;
            const ImuSample sample = walker.move(leaves ? 1.2 : 0);
            if (unit) filter.update({walker.time(), 0, 0, sample});
            if (!heard || ++samples % 50 != 0) continue;
            for (const auto& each : radios.hear(walker.position_m())) hear(each);
            errors_m += error_m();
            ++errors;
        }
    }
    Verdict hear(const radio::Reading& reading) {
        SignalStrength strength{reading.beacon, address(1), static_cast<float>(reading.rssi_dbm)};
        return filter.update({walker.time(), 0, 0, strength});
    }
    Estimate estimate() const { return filter.predict(walker.time()); }
    double error_m() const {
        const Vec3 place = estimate().position_site_m;
        return std::hypot(place[0] - walker.position_m().x(), place[1] - walker.position_m().y());
    }
    double mean_m() const { return errors_m / errors; }

    Site site_;
    SimulatedRadios radios;
    RadioParticlesSettings settings;
    RadioParticles filter;
    SimulatedWalker walker;
    bool unit;
    int samples = 0, errors = 0;
    double errors_m = 0;
};

} // namespace locus::test
