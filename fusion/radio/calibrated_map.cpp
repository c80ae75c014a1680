#include "fusion/radio/calibrated_map.h"

#include <cmath>

namespace locus::radio {

void CalibratedMap::learn(Address teacher, const Eigen::Vector2d& position_site_m, std::span<const Reading> heard) {
    constexpr double farthest = 3; // reaches
    for (std::size_t p = 0; p < now_.points.size(); ++p) {
        const ReferencePoint& point = now_.points[p];
        const Eigen::Vector2d place(point.position_site_m[0], point.position_site_m[1]);
        const double reaches = (place - position_site_m).norm() / settings_.reach_m;
        if (reaches > farthest) continue;
        const double share = settings_.gain * std::exp(-0.5 * reaches * reaches);
        for (std::size_t s = 0; s < point.heard.size(); ++s)
            for (const Reading& reading : heard)
                if (reading.beacon == point.heard[s].beacon)
                    move(p, s, share * (reading.rssi_dbm - point.heard[s].mean_dbm), teacher);
    }
}

void CalibratedMap::move(std::size_t point, std::size_t strength, double wanted_db, Address teacher) {
    const double surveyed = surveyed_.points[point].heard[strength].mean_dbm;
    double& now = now_.points[point].heard[strength].mean_dbm;
    const double next = std::clamp(now + wanted_db, surveyed - settings_.most_db, surveyed + settings_.most_db);
    lessons_.push_back({teacher, point, strength, next - now});
    now = next;
    if (lessons_.size() > settings_.memory) lessons_.pop_front();
}

void CalibratedMap::take_back(Address teacher) {
    std::erase_if(lessons_, [&](const Lesson& lesson) {
        if (lesson.teacher != teacher) return false;
        const double surveyed = surveyed_.points[lesson.point].heard[lesson.strength].mean_dbm;
        double& now = now_.points[lesson.point].heard[lesson.strength].mean_dbm;
        now = std::clamp(now - lesson.moved_db, surveyed - settings_.most_db, surveyed + settings_.most_db);
        return true;
    });
}

} // namespace locus::radio
