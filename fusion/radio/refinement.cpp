#include "fusion/radio/refinement.h"

#include <cmath>

namespace locus::radio {
namespace {

filter::ParticleSettings refinement_cloud(const RefinementSettings& s) {
    filter::ParticleSettings cloud;
    cloud.max_count = s.particles;
    cloud.min_count = s.particles / 2;
    cloud.seed = s.seed;
    return cloud;
}

float distance(const Eigen::Vector2f& place, float x, float y) {
    return std::sqrt((x - place.x()) * (x - place.x()) + (y - place.y()) * (y - place.y()));
}

} // namespace

Refinement::Refinement(const RefinementSettings& settings) : settings_(settings), cloud_(refinement_cloud(settings)) {}

void Refinement::settle() noexcept {
    cloud_.settle();
    cloud_.resample_if_poor();
}

void Refinement::move(double dt_s, const Eigen::Vector2d& fix_m) noexcept {
    if (!started_) {
        filter::Particles::Matrix4 covariance = 1e-6 * filter::Particles::Matrix4::Identity();
        covariance.topLeftCorner<2, 2>() = settings_.fix_sigma_m * settings_.fix_sigma_m * Eigen::Matrix2d::Identity();
        cloud_.start({fix_m.x(), fix_m.y(), 0, 0}, covariance);
        started_ = true;
    } else {
        filter::ParticleMove wander;
        wander.place_sigma_m = settings_.speed_mps * dt_s;
        cloud_.move(wander);
    }
    cloud_.settle();
}

void Refinement::weigh(const Eigen::Vector2d& fix_m) noexcept {
    const Eigen::Vector2f fix = fix_m.cast<float>();
    const auto fix_sigma = static_cast<float>(settings_.fix_sigma_m);
    cloud_.weigh_places([&](float x, float y) { return -distance(fix, x, y) / fix_sigma; });
    settle();
}

void Refinement::weigh_seen(const Eigen::Vector2d& fix_m, const Eigen::Vector2d& seen_m) noexcept {
    const Eigen::Vector2f fix = fix_m.cast<float>(), seen = seen_m.cast<float>();
    const auto by_seen = static_cast<float>(settings_.seen_share / settings_.seen_sigma_m);
    const auto by_fix = static_cast<float>((1 - settings_.seen_share) / settings_.fix_sigma_m);
    cloud_.weigh_places(
        [&](float x, float y) { return -(by_seen * distance(seen, x, y) + by_fix * distance(fix, x, y)); });
    settle();
}

void Refinement::weigh_unseen(const Eigen::Vector2d& fix_m, std::span<const SeenPeer> peers) noexcept {
    if (peers.empty()) return weigh(fix_m);
    const Eigen::Vector2f fix = fix_m.cast<float>();
    const auto by_fix = static_cast<float>(settings_.radio_share / settings_.fix_sigma_m);
    const auto by_peer = static_cast<float>((1 - settings_.radio_share) / static_cast<double>(peers.size()));
    cloud_.weigh_places([&](float x, float y) {
        float off = 0;
        for (const SeenPeer& peer : peers)
            off += std::abs(distance(peer.position_site_m.cast<float>(), x, y) - static_cast<float>(peer.distance_m)) /
                   static_cast<float>(peer.sigma_m);
        return -(by_fix * distance(fix, x, y) + by_peer * off);
    });
    settle();
}

} // namespace locus::radio
