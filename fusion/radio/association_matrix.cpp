#include "fusion/radio/association_matrix.h"

#include <algorithm>
#include <cmath>

namespace locus::radio {
namespace {

/// Of a pair that is worth no memory any more.
constexpr double forgotten = 0.01;
/// Of a new look in what is remembered of a radio.
constexpr float look_share = 0.1f;

double blend(double memory, double before, double now) { return memory * before + (1 - memory) * now; }

} // namespace

double bhattacharyya_distance(const Histogram& p, const Histogram& q) {
    double common = 0;
    for (std::size_t i = 0; i < p.size(); ++i) common += std::sqrt(double{p[i]} * double{q[i]});
    return std::sqrt(std::max(0.0, 1 - common));
}

double AssociationMatrix::element(const Key& key) const {
    const auto found = pairs_.find(key);
    if (found == pairs_.end()) return 0;
    const auto& [trajectory, appearance] = found->second;
    return settings_.trajectory_share * trajectory + (1 - settings_.trajectory_share) * appearance; // eq. 1
}

bool AssociationMatrix::is_largest(const Key& key) const {
    const double own = element(key);
    return own > settings_.least && std::ranges::none_of(pairs_, [&](const auto& other) {
               const bool shares_one = (other.first.first == key.first) != (other.first.second == key.second);
               return shares_one && element(other.first) >= own;
           });
}

double AssociationMatrix::alike(const SeenTrack& track, Address radio) const {
    const auto look = looks_.find(radio);
    return look == looks_.end() ? 1 : 1 - bhattacharyya_distance(track.colours, look->second);
}

void AssociationMatrix::learn_looks(const SeenTrack& track, Address radio) {
    const auto [look, is_new] = looks_.try_emplace(radio, track.colours);
    if (is_new) return;
    for (std::size_t i = 0; i < track.colours.size(); ++i)
        look->second[i] += look_share * (track.colours[i] - look->second[i]);
}

std::vector<RadioPair> AssociationMatrix::update(std::span<const SeenTrack> tracks,
                                                 std::span<const HeardRadio> radios) {
    for (auto& [key, similarity] : pairs_) { // those that are not both there now grow less alike
        similarity.trajectory *= settings_.trajectory_memory;
        similarity.appearance *= settings_.appearance_memory;
    }
    for (const SeenTrack& track : tracks)
        for (const HeardRadio& radio : radios) {
            const bool is_near = (track.position_site_m - radio.position_site_m).norm() < settings_.near_m; // eq. 2
            if (!is_near) continue;
            Similarity& similarity = pairs_[{track.track, radio.radio}];
            similarity.trajectory += blend(settings_.trajectory_memory, 0, 1);                         // eq. 3
            similarity.appearance += blend(settings_.appearance_memory, 0, alike(track, radio.radio)); // eq. 4, 5
        }
    std::erase_if(pairs_, [](const auto& pair) { return pair.second.trajectory < forgotten; });
    std::vector<RadioPair> associated;
    for (const SeenTrack& track : tracks)
        for (const HeardRadio& radio : radios)
            if (const Key key{track.track, radio.radio}; is_largest(key)) {
                associated.push_back({track.track, radio.radio, element(key)});
                learn_looks(track, radio.radio);
            }
    return associated;
}

} // namespace locus::radio
