// What the fusion thread works with until the next reload. Made by the main thread, handed over whole; the old plan
// comes back to be freed where freeing does no harm.
#pragma once

#include "daemon/output.h"
#include "drivers/input.h"
#include "fusion/engine.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace locus {

struct PlannedInput {
    std::shared_ptr<MeasurementRing> ring;
    std::uint16_t index = 0; ///< place in these settings; an input kept open over a reload may have moved
};

struct FusionPlan {
    std::unique_ptr<Engine> engine; ///< null: the engine in use stays, with all it knows
    std::vector<PlannedInput> inputs;
    Generation generation = 0;
    double rate_hz = 100;
    Duration spin{};
    int priority = 0; ///< SCHED_FIFO; 0: ordinary
};

} // namespace locus
