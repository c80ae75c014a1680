// Tags that hear each other (paper 003 eq. 8-9): somebody whom no camera sees is near whom it sees, the nearer the
// stronger. A distance from a strength is known to a factor of two at best, so that the strength itself weighs the
// particles, by the path loss from where the other is.
#include "fusion/estimators/radio_particles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace locus {
namespace {

/// Two who carry tags are no nearer; it also bounds what a small error of the other's place may do.
constexpr double nearest_peer_m = 0.5;

/// What the other's doubt does to the strength that is foreseen: the path loss' slope at that distance.
float peer_variance_db2(const radio::PathLoss& loss, const PeerBelief& other, double distance_m) noexcept {
    const double slope_dbpm = 10 * loss.exponent * std::numbers::log10e / distance_m;
    const double place_m2 = 0.5 * (double{other.covariance_m2[0]} + double{other.covariance_m2[3]});
    return static_cast<float>(loss.sigma_db * loss.sigma_db + slope_dbpm * slope_dbpm * std::max(0.0, place_m2));
}

} // namespace

Verdict RadioParticles::hear_peer(const SignalStrength& strength, Timestamp time) noexcept {
    if (state_.missing != Missing::nothing) return {Exclusion::waiting_for_start};
    walk_.advance(time);
    const Eigen::Vector2d other_m = walk_.local(strength.other.position_site_m);
    const auto foresee = [&](const Eigen::Vector2d& at_m) {
        const double distance_m = std::max((at_m - other_m).norm(), nearest_peer_m);
        return Outlook{static_cast<float>(peer_loss_.expected_dbm(distance_m)),
                       peer_variance_db2(peer_loss_, strength.other, distance_m),
                       {}};
    };
    const Outlook outlook = foresee(cloud().mean().head<2>());
    const double innovation_db = double{strength.rssi_dbm} - double{outlook.mean_dbm};
    Verdict verdict = verdict_of(innovation_db, std::sqrt(double{outlook.variance_db2}), std::sqrt(2 * doubt_limit_));
    const float share = new_share_of_peer(strength.transmitter, time);
    verdict.weight = share;
    walk_.particles().weigh_places([&](float x, float y) {
        const Outlook there = foresee({double{x}, double{y}});
        return share * radio::log_likelihood(strength.rssi_dbm - there.mean_dbm, there.variance_db2, noise_);
    });
    walk_.settle();
    return verdict;
}

float RadioParticles::new_share_of_peer(Address tag, Timestamp time) noexcept {
    auto peer = std::ranges::find_if(state_.peers, [&](const Peer& known) { return known.heard && known.tag == tag; });
    if (peer == state_.peers.end()) {
        peer = std::ranges::min_element(state_.peers, {}, &Peer::heard); // an empty place is before all times
        *peer = {tag, std::nullopt};
    }
    const float share = new_share(peer->heard, time, settings_.held_error_time_s);
    peer->heard = time;
    return share;
}

} // namespace locus
