// UWB ranges simulated for the people of PETS 2009: the radio of tests/papers/walk.h, two-way, ten sweeps a second. A
// path that passes a post is longer by 0.3 to 1.5 m, drawn anew each time that it comes to be blocked. Tags are 1.0 m
// up, give or take 0.15 m from person to person. Where the wearer's body counts as well, it makes the ranges to anchors
// behind him 0.3 m longer, as in paper_001_test.cpp.
#pragma once

#include "tests/papers/posts.h"
#include "tests/replay/pets_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace locus::test {

inline constexpr double sweep_s = 0.1, pets_tag_m = 1.0, pets_tag_sigma_m = 0.15;

inline Address tag_of(std::uint32_t person) { return address(100 + person); }

/// What a blocked path adds, drawn anew whenever it comes to be blocked.
class Blockage {
  public:
    Blockage(const papers::Way& posts_m, unsigned seed) : blocked_(papers::posts(posts_m)), random_(seed) {}
    double longer_m(const Eigen::Vector3d& tag_m, const Eigen::Vector3d& anchor_m, double time_s) {
        double& held_m = held_m_[std::pair(anchor_m.x(), anchor_m.y())];
        if (!(blocked_(tag_m, anchor_m, time_s) > 0)) return held_m = 0;
        if (!(held_m > 0)) held_m = longer_(random_);
        ++count;
        return held_m;
    }
    int count = 0; ///< of ranges that were blocked

  private:
    papers::Blocked blocked_;
    std::mt19937 random_;
    std::uniform_real_distribution<double> longer_{0.3, 1.5};
    std::map<std::pair<double, double>, double> held_m_;
};

struct PetsRanges {
    std::vector<Measurement> all; ///< in the order of their times
    int blocked = 0;
};

inline PetsRanges pets_ranges(const PetsScene& scene, unsigned seed, bool with_body) {
    PetsRanges ranges;
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    for (const auto& [person, way] : scene.ways) {
        papers::Radio radio(scene.site, {}, seed + 1000 * person);
        Blockage blockage(scene.posts_m, seed + 1000 * person + 500);
        const double tag_m = pets_tag_m + pets_tag_sigma_m * normal(random);
        for (double t = std::ceil(way.first_s() / sweep_s) * sweep_s; t <= way.last_s(); t += sweep_s) {
            const auto place_m = way.at(t);
            if (!place_m.has_value()) continue;
            const auto blocked = [&, &path = way](const auto& tag, const auto& anchor, double time_s) {
                const Eigen::Vector2d to_anchor = (anchor - tag).template head<2>().normalized();
                const bool behind = with_body && to_anchor.dot(path.heading(time_s)) < -0.5;
                return blockage.longer_m(tag, anchor, time_s) + (behind ? papers::blocked_longer_m : 0);
            };
            const auto heard_m = radio.hear({place_m.value().x(), place_m.value().y(), tag_m}, t, blocked);
            for (Measurement m : papers::ranges(scene.site, heard_m, t)) {
                std::get<Range>(m.observation).tag = tag_of(person);
                ranges.all.push_back(m);
            }
        }
        ranges.blocked += blockage.count;
    }
    for (std::size_t i = 0; i < ranges.all.size(); ++i) ranges.all[i].sequence = static_cast<std::uint32_t>(i);
    std::sort(ranges.all.begin(), ranges.all.end(), [](const Measurement& a, const Measurement& b) {
        return std::pair(a.time, a.sequence) < std::pair(b.time, b.sequence);
    });
    return ranges;
}

} // namespace locus::test
