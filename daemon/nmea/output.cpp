#include "daemon/nmea/output.h"

#include "daemon/nmea/sentences.h"
#include "drivers/clock.h"

#include <sys/timex.h>

#include <algorithm>

namespace locus {
namespace {

/// A pose that is older is none: the fusion thread stands still.
constexpr Duration freshest_pose_age = std::chrono::seconds{1};

/// Not told where the service manager forbids to ask (ProtectClock): then 23:59:59 comes twice.
bool in_leap_second() {
    timex nothing_changed{};
    return ::adjtimex(&nothing_changed) == TIME_OOP;
}

/// `time` is on the monotonic clock.
UtcTime utc_of(Timestamp time, Timestamp now) {
    const Timestamp utc = read_clock(CLOCK_REALTIME) - (now - time);
    return {std::chrono::floor<std::chrono::microseconds>(utc.time_since_epoch()).count(), in_leap_second()};
}

} // namespace

NmeaOutput::NmeaOutput(const NmeaPlan& plan) : plan_{plan}, earth_{plan.origin}, terminal_{plan.settings.link} {}

bool NmeaOutput::follow(const NmeaPlan& plan) {
    if (plan.settings.link != plan_.settings.link) return false;
    if (plan.target != plan_.target) pose_.reset();
    plan_ = plan;
    earth_ = SiteOnEarth{plan.origin};
    return true;
}

void NmeaOutput::take(const Pose& pose) {
    if (pose.target == plan_.target) pose_ = pose;
}

void NmeaOutput::run(Timestamp now) {
    if (now < next_) return;
    const Duration period = duration_from_s(1 / plan_.settings.rate_hz);
    next_ = std::max(next_ + period, now); // a moment that was missed is not made up for
    const bool fresh = pose_ && now - pose_->estimate.time < freshest_pose_age;
    const Pose* pose = fresh ? &*pose_ : nullptr;
    terminal_.write(nmea_sentences(plan_.settings, earth_, pose, utc_of(fresh ? pose_->estimate.time : now, now)));
}

} // namespace locus
