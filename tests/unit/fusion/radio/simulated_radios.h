// A hall with beacons whose strengths a map does not hold in full: path loss, a deviation that neighbouring places
// share, and one that is new each time. Everything by seed.
#pragma once

#include "fusion/radio/path_loss.h"
#include "fusion/radio/radio_map.h"

#include <Eigen/Core>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace locus::test {

class SimulatedRadios {
  public:
    /// `deafness_dbm`: what is weaker is not heard.
    SimulatedRadios(std::vector<Eigen::Vector2d> beacons_m, unsigned seed, double shared_db = 4, double own_db = 2,
                    double deafness_dbm = -150)
        : beacons_m_(std::move(beacons_m)), own_db_(own_db), deafness_dbm_(deafness_dbm), random_(seed) {
        std::normal_distribution<double> normal;
        std::uniform_real_distribution<double> turn(0, 2 * std::numbers::pi);
        constexpr int waves = 40;
        constexpr double length_m = 4; // a sum of waves of random direction: a Gaussian field, about so far alike
        for (std::size_t b = 0; b < beacons_m_.size(); ++b)
            for (int i = 0; i < waves; ++i) {
                const double y = normal(random_), x = normal(random_); // one by one: the same for every compiler
                waves_.push_back(
                    {b, Eigen::Vector2d(x, y) / length_m, turn(random_), shared_db * std::sqrt(2.0 / waves)});
            }
    }

    double expected_dbm(std::size_t beacon, const Eigen::Vector2d& place_m) const {
        double dbm = loss.expected_dbm(std::hypot((place_m - beacons_m_[beacon]).norm(), 1.5));
        for (const Wave& wave : waves_)
            if (wave.beacon == beacon) dbm += wave.db * std::cos(wave.per_m.dot(place_m) + wave.phase);
        return beacon < weaker_db.size() ? dbm - weaker_db[beacon] : dbm;
    }

    /// Who is heard, once.
    std::vector<radio::Reading> hear(const Eigen::Vector2d& place_m) {
        std::vector<radio::Reading> readings;
        for (std::size_t b = 0; b < beacons_m_.size(); ++b) {
            const double dbm = expected_dbm(b, place_m) + own_db_ * normal_(random_);
            if (dbm >= deafness_dbm_) readings.push_back({address(100 + b), dbm});
        }
        return readings;
    }

    radio::RadioMap survey(double width_m, double depth_m, double step_m) {
        radio::RadioMap map{"hall", "today", "simulated", {}};
        for (int column = 0; column * step_m <= width_m; ++column)
            for (int row = 0; row * step_m <= depth_m; ++row) {
                auto& point = map.points.emplace_back();
                point.position_site_m = {column * step_m, row * step_m, 1.2};
                for (const auto& reading : hear({column * step_m, row * step_m}))
                    point.heard.push_back({reading.beacon, reading.rssi_dbm, 0, 1});
            }
        return map;
    }

    const std::vector<Eigen::Vector2d>& beacons_m() const { return beacons_m_; }

    radio::PathLoss loss{-45, 2.2, 4};
    std::vector<double> weaker_db; ///< of each beacon; left out: none

  private:
    struct Wave {
        std::size_t beacon;
        Eigen::Vector2d per_m;
        double phase, db;
    };
    std::vector<Eigen::Vector2d> beacons_m_;
    double own_db_, deafness_dbm_;
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
    std::vector<Wave> waves_;
};

inline std::vector<Eigen::Vector2d> hall_beacons() { return {{0, 0}, {20, 0}, {20, 12}, {0, 12}, {10, 0}, {10, 12}}; }

} // namespace locus::test
