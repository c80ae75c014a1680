// What the fusion thread hands out: rings and nothing else; four to the publisher, one to who keeps the radio map.
#pragma once

#include "fusion/aid_status.h"
#include "fusion/engine.h"
#include "fusion/pose.h"
#include "fusion/radio/lesson.h"
#include "fusion/ring.h"

namespace locus {

/// Counts the engines of this process; what an old engine gave is told from what the new one gives.
using Generation = std::uint32_t;

struct PoseItem {
    Generation generation = 0;
    Pose pose;
    bool smoothed = false; ///< of smooth_lag_s ago
};

struct SourceItem {
    Generation generation = 0;
    std::uint16_t index = 0; ///< place in Engine::sources()
    std::uint16_t count = 0; ///< how many there are
    AidStatus status;
};

struct TickItem {
    Generation generation = 0;
    Timestamp tick{};
    Duration late{}; ///< from the tick to the thread running again
    std::uint64_t ticks = 0;
    std::uint64_t overruns = 0;      ///< ticks that came late by more than one period
    std::uint64_t poses_dropped = 0; ///< the publisher did not keep up
    bool realtime = false;
    EngineCounters engine;
};

/// How strongly a tag's radio and a beacon heard each other, for those who survey.
struct ReadingItem {
    Timestamp time{};
    Address tag = no_address;
    Address beacon = no_address;
    float rssi_dbm = 0;
};

using LessonRing = Ring<radio::Lesson, 4096>;

/// The largest settings (4096 targets) fit into one tick; what does not fit is dropped and counted by the ring.
struct FusionOutput {
    Ring<PoseItem, 8192> poses;
    Ring<SourceItem, 2048> sources;
    Ring<TickItem, 2048> ticks;
    Ring<ReadingItem, 4096> readings;
    LessonRing lessons; ///< stays full where nobody keeps a map
};

} // namespace locus
