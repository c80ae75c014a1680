// A sleep that ends when the thread is asked to stop.
#pragma once

#include "fusion/time.h"

#include <condition_variable>
#include <mutex>
#include <stop_token>

namespace locus {

inline void sleep_unless_stopped(const std::stop_token& stop, Duration duration) {
    std::mutex mutex;
    std::unique_lock lock{mutex};
    std::condition_variable_any{}.wait_for(lock, stop, duration, [] { return false; });
}

} // namespace locus
