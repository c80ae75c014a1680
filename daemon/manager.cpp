#include "daemon/manager.h"

#include "drivers/clock.h"

#include <fmt/format.h>
#include <systemd/sd-daemon.h>

namespace locus {
namespace {
constexpr Duration status_pause = std::chrono::seconds{1};
}

Manager::Manager() {
    std::uint64_t limit_us = 0;
    if (::sd_watchdog_enabled(0, &limit_us) > 0) feed_every_ = std::chrono::microseconds{limit_us / 4};
}

void Manager::ready() { ::sd_notify(0, "READY=1"); }

void Manager::reloading() {
    ::sd_notify(0, fmt::format("RELOADING=1\nMONOTONIC_USEC={}", to_ns(monotonic_now()) / 1000).c_str());
}

void Manager::stopping() { ::sd_notify(0, "STOPPING=1"); }

void Manager::status(const std::string& text, Timestamp now) {
    if (text == status_ || now - told_ < status_pause) return;
    status_ = text;
    told_ = now;
    ::sd_notify(0, ("STATUS=" + text).c_str());
}

void Manager::alive() {
    fed_ = monotonic_now();
    ::sd_notify(0, "WATCHDOG=1");
}

bool Manager::is_due(Timestamp now) const { return feed_every_ && now - fed_ >= *feed_every_; }

} // namespace locus
