// What the kernel is asked for so that a tick comes on time. All of it is a wish: where it is not allowed, the daemon
// runs without it and says so once.
#pragma once

#include "fusion/time.h"

#include <pthread.h>

#include <string>

namespace locus {

/// Sets a thread's policy explicitly, since a thread inherits that of whoever made it. `priority` above 0: SCHED_FIFO
/// if allowed. Otherwise ordinary scheduling. True: the thread is SCHED_FIFO now. Processors are left as the service
/// manager gave them to the process: no thread here narrows its own mask, so none inherits a narrowed one.
bool schedule_thread(pthread_t thread, int priority) noexcept;

/// The same for the calling thread, with a timer slack of 1 ns, which saves some 50 us on each sleep where scheduling
/// is ordinary.
bool schedule_this_thread(int priority) noexcept;

/// What inputs and the publisher run at when the fusion thread runs at `fusion_priority`: they must not keep a tick
/// waiting, but a pose is no earlier than its bytes are read and its line is written.
constexpr int beside_fusion(int fusion_priority) { return fusion_priority > 0 ? fusion_priority - 1 : 0; }

/// Maps the stack's pages before they are needed.
void touch_stack() noexcept;

/// Locks what is in memory now (MCL_CURRENT: with MCL_FUTURE a low limit would make later allocations fail).
/// Call it once all threads and rings are there, and after each reload. False: not allowed.
bool lock_memory() noexcept;

/// Small stacks for threads made from now on: locked memory holds them whole.
void use_small_stacks() noexcept;

/// As `top -H` and gdb show it; cut to 15 characters.
void name_this_thread(std::string name) noexcept;

/// Sleeps until `wake` on CLOCK_MONOTONIC; may come back early only for a signal.
void sleep_until(Timestamp wake) noexcept;

} // namespace locus
