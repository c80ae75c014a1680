#include "tools/replay/mirror.h"

namespace locus::replay {
namespace {

template <class Numbers>
void negate(Numbers& numbers) {
    for (auto& number : numbers) number = -number;
}

/// True: it has a mirror image, and now is it.
struct Reverse {
    bool operator()(Arrival&) const { return false; }
    bool operator()(ClockSync&) const { return false; }
    bool operator()(GnssRaw&) const { return false; }
    bool operator()(GnssNavigation&) const { return false; }
    bool operator()(GnssBaseRange&) const { return false; }
    bool operator()(ImuSample& imu) const {
        negate(imu.angular_rate_radps);
        return true;
    }
    bool operator()(GnssFix& fix) const {
        negate(fix.velocity_enu_mps);
        return true;
    }
    bool operator()(WheelSpeed& wheel) const {
        wheel.speed_mps = -wheel.speed_mps;
        wheel.yaw_rate_radps = -wheel.yaw_rate_radps;
        return true;
    }
    template <class Other>
    bool operator()(Other&) const {
        return true;
    }
};

} // namespace

std::optional<Measurement> Mirror::measurement(const Measurement& measurement) const {
    Measurement mirrored = measurement;
    mirrored.time = time(measurement.time);
    if (!std::visit(Reverse{}, mirrored.observation)) return {};
    return mirrored;
}

Pose Mirror::pose(Pose pose) const {
    pose.estimate.time = time(pose.estimate.time);
    negate(pose.estimate.velocity_site_mps);
    for (std::size_t i = 0; i < 3; ++i) // position with velocity
        for (std::size_t j = 3; j < 6; ++j) {
            pose.estimate.covariance[6 * i + j] = -pose.estimate.covariance[6 * i + j];
            pose.estimate.covariance[6 * j + i] = -pose.estimate.covariance[6 * j + i];
        }
    return pose;
}

} // namespace locus::replay
