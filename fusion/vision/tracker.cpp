#include "fusion/vision/tracker.h"

#include "fusion/vision/association.h"
#include "fusion/vision/box_geometry.h"

#include <algorithm>
#include <utility>

namespace locus::vision {
namespace {

/// Who stands in front: on a floor, the one whose feet are lower in the image.
bool is_in_front(const Track& front, const Track& back) noexcept {
    return front.filter.foot_px().y() > back.filter.foot_px().y();
}

/// Whether somebody who was seen within the last `recent_s` stands before so much of him.
bool is_covered(const Track& track, std::span<const Track> tracks, double share, double recent_s) noexcept {
    const BoxPx box = track.filter.box();
    return std::any_of(tracks.begin(), tracks.end(), [&](const Track& other) {
        return other.is_confirmed && other.unseen_s <= recent_s && is_in_front(other, track) &&
               covered_share(box, other.filter.box()) >= share;
    });
}

ImageTrack shown(const Track& track) noexcept {
    ImageTrack out;
    out.id = track.id;
    out.box = track.filter.box();
    out.foot_px = track.filter.foot_px();
    out.foot_covariance_px2 = track.filter.foot_covariance_px2();
    out.head_px = track.filter.head_px();
    out.head_covariance_px2 = track.filter.head_covariance_px2();
    out.score = track.score;
    out.age_s = track.age_s;
    out.unseen_s = track.unseen_s;
    out.occluded = track.is_covered;
    out.feet_seen = track.feet_seen;
    out.looks = track.looks;
    return out;
}

} // namespace

std::optional<FloorPoint> stands_at(const FloorView& floor, const ImageTrack& track, const BodyHeight& body) noexcept {
    const auto foot = foot_on_floor(floor, {track.foot_px, track.foot_covariance_px2});
    const auto head = foot_below_head(floor, {track.head_px, track.head_covariance_px2}, body);
    if (!foot || !head) return foot ? foot : head;
    return head->covariance_m2.trace() < foot->covariance_m2.trace() ? head : foot;
}

Tracker::Tracker(const TrackerSettings& settings, std::optional<FloorView> floor, std::uint32_t first_id)
    : settings_(settings), floor_(std::move(floor)), next_id_(first_id) {}

std::span<const ImageTrack> Tracker::update(Timestamp time, std::span<const Detection> detections) {
    if (last_ && time <= *last_) return shown_;
    predict(last_ ? to_s(time - *last_) : 0);
    last_ = time;
    detections = detections.first(std::min(detections.size(), max_detections));
    const Association found = associate(tracks_, detections, settings_, floor_ ? &*floor_ : nullptr);
    for (const auto& [track, detection] : found.pairs) see(tracks_[track], detections[detection]);
    forget();
    for (const std::size_t stranger : found.strangers) begin(detections[stranger]);
    show();
    return shown_;
}

void Tracker::predict(double dt_s) {
    for (Track& track : tracks_) track.predict(dt_s);
    for (Track& track : tracks_) track.is_covered = is_covered(track, tracks_, settings_.covered_share, dt_s);
}

void Tracker::see(Track& track, const Detection& detection) const {
    track.feet_seen = !track.is_covered || detection.box.height_px >= settings_.whole_height * track.filter.height_px();
    track.feet_seen ? track.filter.update(detection.box) : track.filter.update_without_feet(detection.box);
    track.gallery.add(detection.appearance);
    if (!track.is_covered && detection.looks != Looks{}) track.looks = detection.looks;
    track.seen_box = track.filter.box();
    track.score = detection.score;
    track.unseen_s = 0;
    track.is_confirmed = track.is_confirmed || ++track.hits >= settings_.confirming_hits;
}

/// A suspicion is dropped the first time that nobody is there.
void Tracker::forget() {
    std::erase_if(tracks_,
                  [&](const Track& track) { return track.unseen_s > (track.is_confirmed ? settings_.lost_s : 0); });
}

void Tracker::begin(const Detection& detection) {
    if (detection.score < settings_.first_score) return;
    Track& track = tracks_.emplace_back(next_id_++, detection, settings_);
    track.is_confirmed = track.hits >= settings_.confirming_hits;
}

void Tracker::show() {
    shown_.clear();
    for (const Track& track : tracks_)
        if (track.is_confirmed && (track.is_covered || track.unseen_s <= settings_.shown_unseen_s))
            shown_.push_back(shown(track));
}

} // namespace locus::vision
