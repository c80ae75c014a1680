#include "fusion/uwb/clock_sync/blink_pool.h"

#include <algorithm>

namespace locus::uwb {

bool Blink::was_heard_by(ClockGraph::Node anchor) const noexcept {
    return std::ranges::any_of(arrivals(), [&](const HeardBlink& h) { return h.anchor == anchor; });
}

void Blink::drop(const HeardBlink& one) noexcept {
    const auto place = heard.begin() + (&one - heard.data());
    std::move(place + 1, heard.begin() + static_cast<std::ptrdiff_t>(count), place);
    --count;
}

Exclusion BlinkPool::keep(const Measurement& arrival, ClockGraph::Node anchor, const AidBook::Record& record) noexcept {
    const auto& observation = *std::get_if<Arrival>(&arrival.observation);
    Blink* blink = waiting_blink(observation, arrival.time);
    if (!blink) blink = open_blink(observation, arrival.time);
    if (!blink || blink->count == Blink::most_heard) return Exclusion::window_full;
    if (blink->was_heard_by(anchor)) return Exclusion::duplicate;
    blink->time = std::min(blink->time, arrival.time);
    blink->heard[blink->count++] = {anchor, arrival, record, std::nullopt};
    return Exclusion::none;
}

/// The newest are the likeliest.
Blink* BlinkPool::waiting_blink(const Arrival& arrival, Timestamp time) noexcept {
    const auto found = std::find_if(waiting_.rbegin(), waiting_.rend(), [&](const Blink* blink) {
        return blink->tag == arrival.tag && blink->sequence == arrival.sequence && time - blink->time <= gather_ &&
               blink->time - time <= gather_;
    });
    return found == waiting_.rend() ? nullptr : *found;
}

Blink* BlinkPool::open_blink(const Arrival& arrival, Timestamp time) noexcept {
    if (free_.empty()) return nullptr;
    Blink* blink = free_.back();
    free_.pop_back();
    blink->tag = arrival.tag;
    blink->sequence = arrival.sequence;
    blink->time = time;
    blink->count = 0;
    waiting_.push_back(blink);
    return blink;
}

} // namespace locus::uwb
