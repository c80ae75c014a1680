#include "fusion/radio/teachers.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace locus::radio {

Teachers::Teachers(std::size_t targets) : courses_(max_courses), places_(targets) {
    lessons_.reserve(max_lessons + max_courses); // every course may be withdrawn besides
}

void Teachers::see(std::size_t target, const FootPoint& foot, double confidence, Timestamp time) noexcept {
    const std::size_t course = course_of(target, foot, time);
    if (confidence < least_confidence) courses_[course].since = time; // sure from now on at the earliest
    places_[target] = {course, time, {foot.position_site_m[0], foot.position_site_m[1]}};
    place_count_ = std::max(place_count_, target + 1);
}

/// A track that had another name teaches under a new number, and what the other taught as this track is withdrawn.
std::size_t Teachers::course_of(std::size_t target, const FootPoint& foot, Timestamp time) noexcept {
    auto course = std::ranges::find_if(courses_, [&](const Course& known) {
        return known.number != 0 && known.camera == foot.camera && known.track == foot.track;
    });
    if (course == courses_.end()) {
        course = std::ranges::min_element(courses_, {}, &Course::last);
        begin(*course, target, foot, time);
    } else if (course->target != target) {
        push({course->number, true, {}, {}});
        begin(*course, target, foot, time);
    }
    course->last = time;
    return static_cast<std::size_t>(course - courses_.begin());
}

void Teachers::begin(Course& course, std::size_t target, const FootPoint& foot, Timestamp time) noexcept {
    course = {foot.camera, foot.track, target, ++last_number_, time, time};
}

void Teachers::hear(std::size_t target, const Reading& reading, Timestamp time) noexcept {
    const Place& place = places_[target];
    if (place.course == no_course || to_s(time - place.time) > feet_hold_s) return;
    const Course& course = courses_[place.course];
    if (course.target != target || to_s(time - course.since) < sure_after_s) return;
    if (!is_alone(target, time)) return;
    if (reading.rssi_dbm < weakest_dbm || reading.rssi_dbm > strongest_dbm) return;
    push({course.number, false, place.position_site_m, reading});
}

bool Teachers::is_alone(std::size_t target, Timestamp time) const noexcept {
    const auto& [x, y] = places_[target].position_site_m;
    for (std::size_t other = 0; other < place_count_; ++other) {
        const Place& place = places_[other];
        if (other == target || place.course == no_course || to_s(time - place.time) > feet_hold_s) continue;
        if (std::hypot(place.position_site_m[0] - x, place.position_site_m[1] - y) < alone_m) return false;
    }
    return true;
}

void Teachers::push(const Lesson& lesson) noexcept {
    if (std::exchange(was_taken_, false)) lessons_.clear();
    const std::size_t room = lesson.is_withdrawn ? lessons_.capacity() : max_lessons;
    if (lessons_.size() < room) lessons_.push_back(lesson);
}

std::span<const Lesson> Teachers::take() noexcept {
    if (std::exchange(was_taken_, true)) lessons_.clear();
    return lessons_;
}

} // namespace locus::radio
