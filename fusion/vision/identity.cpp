#include "fusion/vision/identity.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <limits>

namespace locus::vision {
namespace {

/// Squared Mahalanobis distance, and what is lacking in proof where the ellipse is wider than usual: ln det S / det S0.
double distance2(const SeenPerson& person, const LocatedTag& tag, double usual_sigma_m) {
    const Eigen::Matrix2d spread = person.covariance_m2 + tag.covariance_m2;
    const Eigen::Vector2d way_m = person.position_site_m - tag.position_site_m;
    const double wider = std::log(spread.determinant()) - 4 * std::log(usual_sigma_m);
    return way_m.dot(spread.inverse() * way_m) + std::max(wider, 0.0);
}

/// A look is learnt from a name that is no likelier wrong than one in ten.
constexpr double sure = 0.9;

} // namespace

Identity::Identity(const IdentitySettings& settings, std::size_t max_tags, CameraLooks looks)
    : settings_(settings), max_tags_(std::max<std::size_t>(max_tags, 1)), looks_(looks), tags_(max_tags_),
      tracks_(max_people), evidence_(max_people * max_tags_), costs_(max_people, max_tags_),
      assigner_(max_people, max_tags_) {
    seen_.reserve(max_people);
    held_before_.reserve(max_people);
    named_.reserve(max_people);
}

std::span<const Named> Identity::update(Timestamp time, std::span<const SeenPerson> people,
                                        std::span<const LocatedTag> tags) noexcept {
    people = people.first(std::min(people.size(), max_people));
    forget(time);
    seen_.clear();
    for (const SeenPerson& person : people) {
        seen_.push_back(place_of(person.track, time));
        for (const LocatedTag& tag : tags) weigh(time, person, seen_.back(), tag);
    }
    assign_tags();
    if (settings_.looks_weight > 0) learn_looks(time, people);
    named_.clear();
    for (const std::size_t track : seen_) named_.push_back(named(track));
    return named_;
}

std::size_t Identity::place_of(std::uint32_t track, Timestamp time) noexcept {
    const auto place = place_of_track(tracks_, track, never);
    const bool is_new = place->last == never || place->number != track;
    const auto number = static_cast<std::size_t>(place - tracks_.begin());
    if (is_new) {
        clear(number);
        place->number = track;
    }
    if (place->held != nobody)
        place->confidence *= settings_.keep_s > 0 ? std::exp(-to_s(time - place->last) / settings_.keep_s) : 0;
    place->last = time;
    return number;
}

void Identity::clear(std::size_t track) noexcept {
    tracks_[track] = {};
    std::fill_n(&evidence(track, 0), max_tags_, Evidence{});
}

/// A running mean whose memory is the window; it begins as a plain mean. No single distance counts for more than twice
/// the gate, so that one outlier parts nobody.
void Identity::weigh(Timestamp time, const SeenPerson& person, std::size_t track, const LocatedTag& tag) noexcept {
    const double apart = distance2(person, tag, settings_.sigma_m) + looks_term(person, tag.tag);
    const double distance = std::min(apart, 2 * settings_.gate);
    const std::uint16_t number = std::isfinite(distance) ? tags_.of(tag.tag) : nobody;
    if (number == nobody) return;
    Evidence& known = evidence(track, number);
    const bool is_new = known.last == never;
    if (!is_new && time <= known.last) return;
    const double dt_s = is_new ? 0 : std::min(to_s(time - known.last), settings_.window_s);
    known.weighed_s += dt_s;
    const double plain_share = is_new ? 1 : dt_s / (known.weighed_s + dt_s);
    known.mean += std::max(plain_share, 1 - std::exp(-dt_s / settings_.window_s)) * (distance - known.mean);
    known.last = time;
}

double Identity::looks_term(const SeenPerson& person, Address tag) const noexcept {
    if (settings_.looks_weight == 0) return 0;
    const auto seen = colours_of(person.looks);
    return seen.has_value() ? settings_.looks_weight * looks_.doubt(tag, seen.value()) : 0;
}

/// Not from a confidence that is only kept: after a swap of the tracker it would be of the other one.
void Identity::learn_looks(Timestamp time, std::span<const SeenPerson> people) const noexcept {
    for (std::size_t i = 0; i < people.size(); ++i) {
        const std::uint16_t tag = tracks_[seen_[i]].held;
        if (tag == nobody || confidence(seen_[i], tag) < sure) continue;
        const auto seen = colours_of(people[i].looks);
        if (seen.has_value()) looks_.learn(tags_[tag], seen.value(), time);
    }
}

/// A pair that was not seen together for long is strange again, and parts.
void Identity::forget(Timestamp time) noexcept {
    const auto is_stale = [&](Timestamp last) { return last != never && to_s(time - last) > settings_.forget_s; };
    for (std::size_t track = 0; track < tracks_.size(); ++track) {
        if (tracks_[track].last == never) continue;
        if (is_stale(tracks_[track].last)) clear(track);
        for (std::size_t tag = 0; tag < tags_.size(); ++tag)
            if (is_stale(evidence(track, tag).last)) evidence(track, tag) = {};
        Track& known = tracks_[track];
        if (known.held != nobody && evidence(track, known.held).last == never) known.held = nobody;
    }
}

/// Of people in the image with all tags that there is evidence of; a tag whose track is out of sight may go to another.
void Identity::assign_tags() noexcept {
    costs_.reset(seen_.size(), tags_.size());
    for (std::size_t i = 0; i < seen_.size(); ++i)
        for (std::size_t tag = 0; tag < tags_.size(); ++tag)
            costs_.at(i, tag) = cost(seen_[i], tag) - (tracks_[seen_[i]].held == tag ? settings_.loyalty : 0);
    held_before_.clear();
    for (const std::size_t track : seen_) {
        held_before_.push_back(tracks_[track].held);
        tracks_[track].held = nobody;
    }
    for (const auto& [i, tag] : assigner_.assign(costs_, settings_.gate))
        hold(seen_[i], static_cast<std::uint16_t>(tag), held_before_[i] == tag ? tracks_[seen_[i]].confidence : 0);
}

/// `kept`: the confidence that is left from before.
void Identity::hold(std::size_t track, std::uint16_t tag, double kept) noexcept {
    for (Track& other : tracks_)
        if (other.held == tag) other.held = nobody;
    tracks_[track].held = tag;
    tracks_[track].confidence = std::max(kept, confidence(track, tag));
}

double Identity::cost(std::size_t track, std::size_t tag) const noexcept {
    const Evidence& known = evidence(track, tag);
    const bool is_settled = known.last != never && known.weighed_s >= settings_.settle_s;
    return is_settled ? known.mean : std::numeric_limits<double>::infinity();
}

double Identity::confidence(std::size_t track, std::size_t tag) const noexcept {
    const auto likelihood = [&](std::size_t row, std::size_t column) { return std::exp(-0.5 * cost(row, column)); };
    const double this_one = likelihood(track, tag);
    double all = std::exp(-0.5 * settings_.gate) + this_one;
    for (std::size_t other = 0; other < tags_.size(); ++other)
        if (other != tag) all += likelihood(track, other);
    for (std::size_t other = 0; other < tracks_.size(); ++other)
        if (other != track && tracks_[other].last != never) all += likelihood(other, tag);
    return this_one / all;
}

Named Identity::named(std::size_t track) const noexcept {
    const Track& known = tracks_[track];
    if (known.held == nobody) return {known.number, std::nullopt, 0};
    return {known.number, tags_[known.held], known.confidence};
}

} // namespace locus::vision
