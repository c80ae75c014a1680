// What one reading of a beacon says: what the cloud foresees of it, how it weighs the particles, what it teaches of the
// beacon.
#include "fusion/estimators/radio_particles.h"

#include <algorithm>
#include <cmath>

namespace locus {
/// A beacon that says what it sends is known by that; two decibels are left, what beacons of one kind differ by.
void RadioParticles::announce(Beacon& beacon, const SignalStrength& strength) const noexcept {
    constexpr float announced_variance_db2 = 4;
    if (!std::isfinite(strength.tx_power_dbm) || beacon.offset_variance_db2 <= announced_variance_db2) return;
    beacon.offset_db = strength.tx_power_dbm - static_cast<float>(settings_.power_1m_dbm);
    beacon.offset_variance_db2 = announced_variance_db2;
}

RadioParticles::Outlook RadioParticles::foresee(std::size_t beacon) const noexcept {
    const auto step = static_cast<float>(grid().cells().cell_m);
    const Eigen::Vector2f place = walk_.place_site_m().head<2>().cast<float>();
    const radio::Expected here = grid().at(beacon, place.x(), place.y());
    const auto at = [&](float dx, float dy) { return grid().at(beacon, place.x() + dx, place.y() + dy).mean_dbm; };
    Outlook outlook;
    outlook.mean_dbm = here.mean_dbm + state_.beacons[beacon].offset_db;
    outlook.gradient_dbpm =
        Eigen::Vector2f((at(step, 0) - at(-step, 0)) / (2 * step), (at(0, step) - at(0, -step)) / (2 * step))
            .cast<double>();
    const double spread_db2 =
        outlook.gradient_dbpm.dot(cloud().covariance().topLeftCorner<2, 2>() * outlook.gradient_dbpm);
    outlook.variance_db2 =
        here.variance_db2 + state_.beacons[beacon].offset_variance_db2 + static_cast<float>(std::max(0.0, spread_db2));
    return outlook;
}

/// A Kalman filter of one state for the power that a path-loss model does not know.
void RadioParticles::learn_offset(Beacon& beacon, const Outlook& outlook, float innovation_db) noexcept {
    if (beacon.offset_variance_db2 <= 0) return;
    const float gain = beacon.offset_variance_db2 / outlook.variance_db2;
    beacon.offset_db +=
        gain * std::clamp(innovation_db, -3 * std::sqrt(outlook.variance_db2), 3 * std::sqrt(outlook.variance_db2));
    beacon.offset_variance_db2 *= 1 - gain;
}

/// `share` of it, where part was said before.
void RadioParticles::weigh(std::size_t beacon, float rssi_dbm, float share) noexcept {
    const Eigen::Vector2f origin = walk_.origin_site_m().cast<float>();
    const float offset_db2 = state_.beacons[beacon].offset_variance_db2;
    walk_.particles().weigh_places([&](float x, float y) {
        const radio::Expected expected = grid().at(beacon, x + origin.x(), y + origin.y());
        return share * radio::log_likelihood(rssi_dbm - expected.mean_dbm, expected.variance_db2 + offset_db2, noise_);
    });
    walk_.settle();
}

} // namespace locus
