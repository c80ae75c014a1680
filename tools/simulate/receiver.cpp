#include "tools/simulate/receiver.h"

#include <algorithm>

namespace locus::simulate {
namespace {

std::mt19937_64 generator(std::int64_t seed, unsigned number) {
    std::seed_seq mixed{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(number)};
    return std::mt19937_64(mixed);
}

} // namespace

Receiver::Receiver(const Scenario& scenario, Radio radio, unsigned number)
    : scenario_(scenario), radio_(std::move(radio)), random_(generator(scenario.simulation.seed, number)),
      links_(scenario.site.anchors.size() * scenario.movers.size()) {}

std::vector<Receiver::Heard> Receiver::hear(std::size_t mover, const Eigen::Vector3d& position_site_m) {
    const auto& anchors = scenario_.site.anchors;
    std::vector<Heard> heard;
    for (std::size_t i = 0; i < anchors.size(); ++i) {
        Link& link = links_[mover * anchors.size() + i];
        const Eigen::Vector3d anchor_site_m{anchors[i].position_site_m.data()};
        // Drawn whether used or not, so that one wall more does not change the noise of everything after it.
        const double share = uniform(), luck = uniform();
        double bias_m = 0, arrives = 1 - radio_.loss;
        if (!link.shadowed) link.bias_share = share;
        link.shadowed = false;
        for (const Wall& wall : scenario_.walls) {
            if (!crosses(wall, anchor_site_m, position_site_m)) continue;
            link.shadowed = true;
            bias_m += wall.bias_min_m + link.bias_share * (wall.bias_max_m - wall.bias_min_m);
            arrives *= 1 - wall.loss;
        }
        const double distance_m = (position_site_m - anchor_site_m).norm();
        if (distance_m <= radio_.reach_m && luck < arrives) heard.push_back({anchors[i].address, distance_m + bias_m});
    }
    return heard;
}

Range Receiver::range(Address tag, const Heard& heard) {
    Range range;
    range.anchor = heard.anchor;
    range.tag = tag;
    range.range_m = std::max(0.0, heard.distance_m + noise_m());
    range.sigma_m = static_cast<float>(radio_.sigma_m);
    return range;
}

RangeDifference Receiver::difference(Address tag, const Heard& a, const Heard& b) {
    RangeDifference difference;
    difference.anchor_a = a.anchor;
    difference.anchor_b = b.anchor;
    difference.tag = tag;
    difference.difference_m = b.distance_m - a.distance_m + noise_m();
    difference.sigma_m = static_cast<float>(radio_.sigma_m);
    return difference;
}

std::vector<Observation> Receiver::measure(std::size_t mover, const Eigen::Vector3d& position_site_m) {
    const std::vector<Heard> heard = hear(mover, position_site_m);
    const Address tag = scenario_.movers[mover].target.address;
    std::vector<Observation> observations;
    if (radio_.mode == "ranges") {
        for (const Heard& one : heard) observations.emplace_back(range(tag, one));
        return observations;
    }
    for (std::size_t i = 1; i < heard.size(); ++i) observations.emplace_back(difference(tag, heard[i - 1], heard[i]));
    if (heard.size() > 2) observations.emplace_back(difference(tag, heard.back(), heard.front()));
    return observations;
}

} // namespace locus::simulate
