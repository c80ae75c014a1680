#include "fusion/radio/calibrated_map.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace locus::radio {
namespace {

/// Files keep places to a millimetre.
constexpr double same_place_m = 2e-3;

bool is_same_point(const ReferencePoint& a, const ReferencePoint& b) {
    const auto is_near = [](double one, double other) { return std::abs(one - other) <= same_place_m; };
    return std::ranges::equal(a.position_site_m, b.position_site_m, is_near) &&
           std::ranges::equal(a.heard, b.heard, {}, &Strength::beacon, &Strength::beacon);
}

} // namespace

bool is_of_survey(const RadioMap& surveyed, const RadioMap& taught) {
    return std::ranges::equal(surveyed.points, taught.points, is_same_point);
}

CalibratedMap::CalibratedMap(RadioMap surveyed, RadioMap taught, const CalibrationSettings& settings)
    : surveyed_(std::move(surveyed)), now_(std::move(taught)), settings_(settings) {
    if (!is_of_survey(surveyed_, now_)) throw std::invalid_argument("the calibrated map is of another survey");
}

double CalibratedMap::moved_db() const {
    double sum = 0, count = 0;
    for (std::size_t p = 0; p < now_.points.size(); ++p)
        for (std::size_t s = 0; s < now_.points[p].heard.size(); ++s) {
            sum += std::abs(now_.points[p].heard[s].mean_dbm - surveyed_.points[p].heard[s].mean_dbm);
            ++count;
        }
    return count > 0 ? sum / count : 0;
}

void CalibratedMap::learn(std::uint64_t teacher, const Eigen::Vector2d& position_site_m,
                          std::span<const Reading> heard) {
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

void CalibratedMap::heed(const Lesson& lesson) {
    if (lesson.is_withdrawn) return take_back(lesson.course);
    learn(lesson.course, {lesson.position_site_m[0], lesson.position_site_m[1]}, {&lesson.reading, 1});
}

void CalibratedMap::move(std::size_t point, std::size_t strength, double wanted_db, std::uint64_t teacher) {
    const double surveyed = surveyed_.points[point].heard[strength].mean_dbm;
    double& now = now_.points[point].heard[strength].mean_dbm;
    const double next = std::clamp(now + wanted_db, surveyed - settings_.most_db, surveyed + settings_.most_db);
    lessons_.push_back({teacher, point, strength, next - now});
    now = next;
    if (lessons_.size() > settings_.memory) lessons_.pop_front();
}

void CalibratedMap::take_back(std::uint64_t teacher) {
    std::erase_if(lessons_, [&](const Taught& lesson) {
        if (lesson.teacher != teacher) return false;
        const double surveyed = surveyed_.points[lesson.point].heard[lesson.strength].mean_dbm;
        double& now = now_.points[lesson.point].heard[lesson.strength].mean_dbm;
        now = std::clamp(now - lesson.moved_db, surveyed - settings_.most_db, surveyed + settings_.most_db);
        return true;
    });
}

} // namespace locus::radio
