#include "tools/interrupt.h"

#include <cerrno>
#include <csignal>
#include <ctime>

namespace locus::tools {
namespace {

volatile std::sig_atomic_t raised = 0; // NOLINT(*-non-const-global-variables): all that a signal handler can reach

} // namespace

void catch_interrupts() {
    struct sigaction action{};
    action.sa_handler = [](int) { raised = 1; };
    ::sigaction(SIGINT, &action, nullptr);
    ::sigaction(SIGTERM, &action, nullptr);
    ::signal(SIGPIPE, SIG_IGN);
}

bool interrupted() { return raised != 0; }

void sleep_until_or_interrupted(Timestamp time) {
    const std::int64_t ns = to_ns(time);
    const timespec until{ns / 1'000'000'000, ns % 1'000'000'000};
    while (!interrupted() && ::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
    }
}

} // namespace locus::tools
