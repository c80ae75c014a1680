#include "fusion/timeline.h"

#include <algorithm>

namespace locus {

void Timeline::State::copy_from(const State& other) noexcept {
    estimator->copy_from(*other.estimator);
    last = other.last;
    last_used = other.last_used;
    resets = other.resets;
}

Timeline::Timeline(const Estimator& fresh, const TimelineLimits& limits)
    : fresh_(fresh), limits_(limits), entries_(limits.measurements), head_(fresh) {
    snapshots_.reserve(limits.snapshots);
    for (std::size_t i = 0; i < limits.snapshots; ++i) snapshots_.emplace_back(fresh);
}

Exclusion Timeline::insert(const Measurement& measurement, const SampleKey& key,
                           const AidBook::Record& record) noexcept {
    // Nearly always at or close to the end, so the place is looked for from there.
    auto place = entries_.end();
    while (place != entries_.begin() && key < (place - 1)->key) --place;
    if (place != entries_.begin() && (place - 1)->key == key) return Exclusion::duplicate;
    if (entries_.full()) return Exclusion::window_full;
    const auto index = static_cast<std::size_t>(place - entries_.begin());
    entries_.insert(place, Entry{key, measurement, record});
    if (index < next_) {
        ++next_;
        dirty_ = std::min(dirty_, index);
    }
    return Exclusion::none;
}

void Timeline::run(Timestamp tick, Timestamp horizon, AidBook& book) noexcept {
    if (dirty_ != clean) {
        rewind();
        book.count_roll_back();
    }
    while (next_ < entries_.size() && entries_[next_].key.time <= tick) {
        take_snapshot_before(entries_[next_]);
        apply(entries_[next_], book);
        ++next_;
    }
    forget(horizon);
}

void Timeline::rewind() noexcept {
    const SampleKey& key = entries_[dirty_].key;
    while (snapshot_count_ > 1 && key < newest_snapshot().last) --snapshot_count_;
    head_.copy_from(newest_snapshot());
    next_ = dirty_;
    while (next_ > 0 && head_.last < entries_[next_ - 1].key) --next_;
    dirty_ = clean;
}

void Timeline::apply(Entry& entry, AidBook& book) noexcept {
    if (is_lost(entry.key.time)) start_anew();
    const Verdict verdict = head_.estimator->update(entry.measurement);
    head_.last = entry.key;
    if (verdict.reason == Exclusion::none) head_.last_used = entry.key.time;
    book.judge(entry.measurement, entry.record, verdict);
}

bool Timeline::is_lost(Timestamp time) const noexcept {
    return head_.last_used != SampleKey::never && time - head_.last_used > limits_.lost_after;
}

void Timeline::start_anew() noexcept {
    head_.resets += head_.estimator->predict(head_.last.time).reset_count + 1;
    head_.last_used = SampleKey::never;
    head_.estimator->copy_from(fresh_);
}

/// Between samples of one time there is no snapshot: a sweep over all anchors is never cut in two. When all slots are
/// taken the next roll-back has a longer way, that is all.
void Timeline::take_snapshot_before(const Entry& entry) noexcept {
    if (head_.last.time == SampleKey::never || entry.key.time == head_.last.time) return;
    const State& newest = newest_snapshot();
    const bool due =
        newest.last.time == SampleKey::never || head_.last.time - newest.last.time >= limits_.snapshot_spacing;
    if (!due || snapshot_count_ == snapshots_.size()) return;
    ++snapshot_count_;
    newest_snapshot().copy_from(head_);
}

void Timeline::drop_oldest_snapshot() noexcept {
    first_snapshot_ = (first_snapshot_ + 1) % snapshots_.size();
    --snapshot_count_;
}

/// Whatever comes from now on lies at or after the horizon, so the newest snapshot before it is as far back as a
/// roll-back can go.
void Timeline::forget(Timestamp horizon) noexcept {
    while (snapshot_count_ > 1 && snapshot(1).last.time < horizon) drop_oldest_snapshot();
    State& oldest = snapshot(0);
    if (oldest.last < head_.last && head_.last.time < horizon) oldest.copy_from(head_);
    while (next_ > 0 && entries_.front().key <= oldest.last) {
        entries_.pop_front();
        --next_;
    }
}

Estimate Timeline::predict(Timestamp tick) const noexcept {
    Estimate estimate;
    if (head_.last.time != SampleKey::never) estimate = head_.estimator->predict(tick);
    estimate.time = tick;
    estimate.reset_count += head_.resets;
    if (is_lost(tick)) estimate.missing = Missing::fresh_measurements;
    return estimate;
}

} // namespace locus
