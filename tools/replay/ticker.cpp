#include "tools/replay/ticker.h"

#include <utility>

namespace locus::replay {

Ticker::Ticker(Engine& engine, OnPoses on_poses)
    : engine_(engine), on_poses_(std::move(on_poses)), period_(duration_from_s(1 / engine.settings().fusion.rate_hz)),
      silence_(duration_from_s(engine.settings().fusion.lost_after_s) + period_) {}

Timestamp Ticker::grid_at_or_after(Timestamp time) const {
    const Duration since_zero = time.time_since_epoch();
    const Duration past = since_zero % period_;
    return past > Duration::zero() ? time - past + period_ : time - past;
}

void Ticker::take(const Measurement& measurement, Timestamp arrival) {
    if (!started_) next_tick_ = grid_at_or_after(arrival);
    if (!started_ || arrival > now_) {
        tick_until(arrival);
        now_ = arrival;
    }
    started_ = true;
    engine_.submit(measurement, now_);
}

void Ticker::finish() {
    if (started_) tick_until(next_tick_ + Duration{1});
}

/// A recording with a long silence is not ticked through all of it: there is nothing to be said after a while.
void Ticker::tick_until(Timestamp end) {
    const Timestamp silent = now_ + silence_;
    while (next_tick_ < end) {
        on_poses_(engine_.step(next_tick_));
        next_tick_ += period_;
        if (started_ && next_tick_ > silent && end > next_tick_) next_tick_ = grid_at_or_after(end);
    }
}

} // namespace locus::replay
