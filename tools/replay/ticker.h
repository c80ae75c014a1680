// The engine run in a recording's own time: what the fusion thread does by the clock, as fast as it goes. Ticks stand
// at whole multiples of the period, so the same recording gives the same poses every time.
#pragma once

#include "fusion/engine.h"

#include <functional>
#include <span>

namespace locus::replay {

class Ticker {
  public:
    /// Gets what Engine::step() gave.
    using OnPoses = std::function<void(std::span<const Pose>)>;

    Ticker(Engine& engine, OnPoses on_poses);

    /// Ticks up to the arrival, then submits. An arrival before the last one counts as coming right after it.
    void take(const Measurement& measurement, Timestamp arrival);

    /// The tick that takes in the last measurements.
    void finish();

  private:
    Timestamp grid_at_or_after(Timestamp time) const;
    void tick_until(Timestamp end);

    Engine& engine_;
    OnPoses on_poses_;
    Duration period_;
    Duration silence_; ///< after which no target has a pose
    bool started_ = false;
    Timestamp now_{};
    Timestamp next_tick_{};
};

} // namespace locus::replay
