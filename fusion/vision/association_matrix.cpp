#include "fusion/vision/association_matrix.h"

#include <algorithm>
#include <cmath>

namespace locus::vision {
namespace {

/// After so many time constants a memory is worth less than one in a hundred.
constexpr double worthless_after = 5;

} // namespace

AssociationMatrix::AssociationMatrix(const AssociationSettings& settings, std::size_t max_tags, CameraLooks looks)
    : settings_(settings), max_tags_(std::max<std::size_t>(max_tags, 1)), looks_(looks), tags_(max_tags_),
      tracks_(max_people), pairs_(max_people * max_tags_) {
    seen_.reserve(max_people);
    named_.reserve(max_people);
}

std::span<const Named> AssociationMatrix::update(Timestamp time, std::span<const SeenPerson> people,
                                                 std::span<const LocatedTag> tags) noexcept {
    people = people.first(std::min(people.size(), max_people));
    fade(time);
    seen_.clear();
    for (const SeenPerson& person : people) {
        const std::size_t track = place_of(person.track);
        const bool is_new = tracks_[track].last == never;
        const double dt_s = is_new ? 0 : to_s(time - tracks_[track].last);
        tracks_[track].last = time;
        seen_.push_back(track);
        const auto seen = colours_of(person.looks);
        for (const LocatedTag& tag : tags)
            if ((person.position_site_m - tag.position_site_m).norm() < settings_.near_m) // eq. 2
                meet(dt_s, track, seen, tag);
    }
    named_.clear();
    for (const std::size_t track : seen_) named_.push_back(named(track));
    for (std::size_t i = 0; i < named_.size(); ++i) {
        const std::optional<Address>& tag = named_[i].tag;
        if (!tag.has_value()) continue;
        const auto seen = colours_of(people[i].looks);
        if (seen.has_value()) looks_.learn(tag.value(), seen.value(), time);
    }
    return named_;
}

/// Those that are not both there now grow less alike.
void AssociationMatrix::fade(Timestamp time) noexcept {
    const double dt_s = last_ == never ? 0 : std::max(0.0, to_s(time - last_));
    last_ = time;
    const double trajectory = std::exp(-dt_s / settings_.trajectory_time_s);
    const double looks = std::exp(-dt_s / settings_.looks_time_s);
    const double worthless_s = worthless_after * std::max(settings_.trajectory_time_s, settings_.looks_time_s);
    for (std::size_t track = 0; track < tracks_.size(); ++track) {
        if (tracks_[track].last == never) continue;
        if (to_s(time - tracks_[track].last) > worthless_s) clear(track);
        for (std::size_t tag = 0; tag < tags_.size(); ++tag) {
            similarity(track, tag).trajectory *= trajectory;
            similarity(track, tag).looks *= looks;
        }
    }
}

void AssociationMatrix::clear(std::size_t track) noexcept {
    tracks_[track] = {};
    std::fill_n(&similarity(track, 0), max_tags_, Similarity{});
}

std::size_t AssociationMatrix::place_of(std::uint32_t track) noexcept {
    const auto place = place_of_track(tracks_, track, never);
    const bool is_new = place->last == never || place->number != track;
    const auto number = static_cast<std::size_t>(place - tracks_.begin());
    if (is_new) clear(number);
    tracks_[number].number = track;
    return number;
}

void AssociationMatrix::meet(double dt_s, std::size_t track, const std::optional<Colours>& seen,
                             const LocatedTag& tag) noexcept {
    const std::uint16_t number = tags_.of(tag.tag);
    if (number == TagNumbers::none) return;
    const auto known = looks_.colours(tag.tag);
    const bool can_compare = seen.has_value() && known.has_value();
    const double alike = can_compare ? 1 - bhattacharyya_distance(seen.value(), known.value()) : 1;
    Similarity& pair = similarity(track, number);
    pair.trajectory += 1 - std::exp(-dt_s / settings_.trajectory_time_s); // eq. 3
    pair.looks += (1 - std::exp(-dt_s / settings_.looks_time_s)) * alike; // eq. 4, 5
}

double AssociationMatrix::element(std::size_t track, std::size_t tag) const noexcept {
    const auto& [trajectory, looks] = similarity(track, tag);
    return settings_.trajectory_share * trajectory + (1 - settings_.trajectory_share) * looks; // eq. 1
}

bool AssociationMatrix::is_largest(std::size_t track, std::size_t tag) const noexcept {
    const double own = element(track, tag);
    for (std::size_t other = 0; other < tags_.size(); ++other)
        if (other != tag && element(track, other) >= own) return false;
    for (std::size_t other = 0; other < tracks_.size(); ++other)
        if (other != track && tracks_[other].last != never && element(other, tag) >= own) return false;
    return true;
}

Named AssociationMatrix::named(std::size_t track) const noexcept {
    for (std::size_t tag = 0; tag < tags_.size(); ++tag) {
        const double own = element(track, tag);
        if (own > settings_.least_element && is_largest(track, tag))
            return {tracks_[track].number, tags_[tag], std::min(own, 1.0)};
    }
    return {tracks_[track].number, std::nullopt, 0};
}

} // namespace locus::vision
