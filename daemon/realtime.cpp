#include "daemon/realtime.h"

#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>

#include <algorithm>
#include <cstddef>
#include <ctime>

namespace locus {
namespace {

constexpr std::size_t stack_bytes = std::size_t{512} << 10;
constexpr std::size_t touched_bytes = std::size_t{128} << 10;

bool set_policy(pthread_t thread, int policy, int priority) noexcept {
    sched_param parameters{};
    parameters.sched_priority = priority;
    return ::pthread_setschedparam(thread, policy, &parameters) == 0;
}

} // namespace

bool schedule_thread(pthread_t thread, int priority) noexcept {
    if (priority > 0 && set_policy(thread, SCHED_FIFO, priority)) return true;
    set_policy(thread, SCHED_OTHER, 0);
    return false;
}

bool schedule_this_thread(int priority) noexcept {
    ::prctl(PR_SET_TIMERSLACK, 1UL);
    return schedule_thread(::pthread_self(), priority);
}

void touch_stack() noexcept {
    volatile std::byte pages[touched_bytes];
    for (std::size_t at = 0; at < touched_bytes; at += 4096) pages[at] = std::byte{0};
    static_cast<void>(pages[0]);
}

bool lock_memory() noexcept { return ::mlockall(MCL_CURRENT) == 0; }

void use_small_stacks() noexcept {
    pthread_attr_t attributes;
    if (::pthread_attr_init(&attributes) != 0) return;
    ::pthread_attr_setstacksize(&attributes, stack_bytes);
    ::pthread_setattr_default_np(&attributes);
    ::pthread_attr_destroy(&attributes);
}

void name_this_thread(std::string name) noexcept {
    name.resize(std::min<std::size_t>(name.size(), 15));
    ::pthread_setname_np(::pthread_self(), name.c_str());
}

void sleep_until(Timestamp wake) noexcept {
    const auto ns = to_ns(wake);
    const timespec time{ns / 1'000'000'000, ns % 1'000'000'000};
    ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr);
}

} // namespace locus
