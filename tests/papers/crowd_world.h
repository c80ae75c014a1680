// A floor with ZigBee beacons on its ceiling and a cluster of people who carry tags, as in paper 003 section 6, drawn
// from a seed. Bodies stand in the way of each other's radio: the more people, the less a map of the empty floor is
// worth. A camera sees some of them.
#pragma once

#include "fusion/vision/colours.h"
#include "fusion/vision/naming.h"
#include "tests/unit/fusion/radio/simulated_radios.h"

#include <Eigen/Core>

#include <cmath>
#include <random>
#include <vector>

namespace locus::test {

class CrowdWorld {
  public:
    static constexpr double width_m = 20, depth_m = 12, frame_s = 0.5;

    CrowdWorld(std::size_t people, unsigned seed)
        : radios({{2, 2}, {10, 2}, {18, 2}, {2, 10}, {10, 10}, {18, 10}, {6, 6}, {14, 6}}, seed, 3, 2), random_(seed) {
        for (std::size_t i = 0; i < people; ++i) {
            places.emplace_back(3 + 14 * uniform(), 2 + 8 * uniform());
            offsets_.emplace_back(normal(0.7), normal(0.7));
            vision::Colours& look = looks_.emplace_back(vision::Colours::Zero());
            for (float& part : look.head(colours)) part = static_cast<float>(uniform() * uniform());
            look /= look.sum();
        }
        goal_ = middle_ = {10, 6};
    }

    /// Apart, each on a way of his own, or together in a cluster.
    void step(bool together) {
        const Eigen::Vector2d to_goal = goal_ - middle_;
        if (to_goal.norm() < 0.5) goal_ = {3 + 14 * uniform(), 2 + 8 * uniform()};
        middle_ += 0.6 * frame_s * to_goal / std::max(0.1, to_goal.norm());
        for (std::size_t i = 0; i < places.size(); ++i) {
            offsets_[i] = 0.98 * offsets_[i] + Eigen::Vector2d(normal(0.14), normal(0.14)); // stays about 0.7 m wide
            const Eigen::Vector2d wanted =
                together ? middle_ + offsets_[i] : Eigen::Vector2d(3 + 3.5 * static_cast<double>(i), i % 2 ? 3 : 9);
            const Eigen::Vector2d way = wanted - places[i];
            places[i] += way * std::min(1.0, 1.4 * frame_s / std::max(way.norm(), 1e-9));
        }
    }

    std::vector<radio::Reading> hear(std::size_t person) {
        std::vector<radio::Reading> heard = radios.hear(places[person]);
        for (std::size_t b = 0; b < heard.size(); ++b)
            heard[b].rssi_dbm -= bodies_db(person, radios.beacons_m()[b], ceiling_share);
        return heard;
    }
    /// Strength that one tag hears another with.
    double hear_tag(std::size_t person, std::size_t other) {
        const double distance_m = (places[person] - places[other]).norm();
        return tags.expected_dbm(distance_m) + normal(tags.sigma_db) - bodies_db(person, places[other], 0.9);
    }
    vision::SeenPerson see(std::size_t person) {
        vision::SeenPerson seen{static_cast<std::uint32_t>(person), places[person],
                                0.15 * 0.15 * Eigen::Matrix2d::Identity()};
        seen.position_site_m += Eigen::Vector2d(normal(0.15), normal(0.15));
        vision::Colours look = looks_[person] + static_cast<float>(alike) / colours; // whose sum is one and this
        for (float& part : look.head(colours)) part *= static_cast<float>(1 - look_noise + 2 * look_noise * uniform());
        seen.looks = vision::looks_of(look / look.sum());
        return seen;
    }
    double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }

    static constexpr radio::PathLoss tags{-50, 2, 3};
    double look_noise = 0.2; ///< of each colour's share, from image to image
    double alike = 0;        ///< what all wear alike, in shares of what each has for himself
    std::vector<Eigen::Vector2d> places;
    SimulatedRadios radios;

  private:
    /// Beacons at 2.6 m, tags at 1.2 m, heads at 1.7 m: beyond this share of the way a path is over people's heads.
    static constexpr double ceiling_share = 0.36;
    /// A body in the way takes 3 to 13 dB at 2.4 GHz, by how it stands just now.
    double bodies_db(std::size_t person, const Eigen::Vector2d& other_end_m, double share) {
        double sum_db = 0;
        const Eigen::Vector2d way = share * (other_end_m - places[person]);
        for (std::size_t i = 0; i < places.size(); ++i) {
            if (i == person) continue;
            const Eigen::Vector2d to_body = places[i] - places[person];
            const double along = std::clamp(to_body.dot(way) / std::max(way.squaredNorm(), 1e-9), 0.0, 1.0);
            if ((to_body - along * way).norm() < 0.4 && along > 0) sum_db += 3 + 10 * uniform();
        }
        return sum_db;
    }
    double normal(double sigma) { return sigma * normal_(random_); }

    std::mt19937 random_;
    std::normal_distribution<double> normal_;
    std::vector<Eigen::Vector2d> offsets_;
    static constexpr int colours = 16; ///< that people wear
    std::vector<vision::Colours> looks_;
    Eigen::Vector2d goal_{0, 0}, middle_{0, 0};
};

} // namespace locus::test
