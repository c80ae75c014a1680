// GLONASS satellites: the equations of motion in the Earth-fixed frame, integrated from the reference time.
#include "fusion/gnss/satellite.h"

#include <cmath>
#include <limits>

namespace locus::gnss {
namespace {

constexpr double mu_m3ps2 = 3.9860044e14;
constexpr double earth_radius_m = 6378136;
constexpr double j2 = 1.0826257e-3;
constexpr double earth_rate_radps = 7.292115e-5;
constexpr double longest_step_s = 60;
constexpr double farthest_s = 43200;

struct Motion {
    Vec3 position_m{}, velocity_mps{};
};

/// motion + rate * step
Motion moved(Motion motion, const Motion& rate, double step_s) {
    for (std::size_t i = 0; i < 3; ++i) {
        motion.position_m[i] += rate.position_m[i] * step_s;
        motion.velocity_mps[i] += rate.velocity_mps[i] * step_s;
    }
    return motion;
}

/// Appendix 3.1.2: the Earth's attraction with J2, its rotation, and the pull of Sun and Moon as broadcast.
Motion rate_of(const Motion& m, const Vec3& sun_and_moon_mps2) {
    const auto& [x, y, z] = m.position_m;
    const double r2 = x * x + y * y + z * z, r3 = r2 * std::sqrt(r2), w2 = earth_rate_radps * earth_rate_radps;
    const double flat = 1.5 * j2 * mu_m3ps2 * earth_radius_m * earth_radius_m / (r2 * r3), tilt = 5 * z * z / r2;
    const double central = -mu_m3ps2 / r3 - flat * (1 - tilt);
    return {m.velocity_mps,
            {(central + w2) * x + 2 * earth_rate_radps * m.velocity_mps[1] + sun_and_moon_mps2[0],
             (central + w2) * y - 2 * earth_rate_radps * m.velocity_mps[0] + sun_and_moon_mps2[1],
             (-mu_m3ps2 / r3 - flat * (3 - tilt)) * z + sun_and_moon_mps2[2]}};
}

Motion runge_kutta(const Motion& motion, const Vec3& sun_and_moon_mps2, double step_s) {
    const Motion k1 = rate_of(motion, sun_and_moon_mps2);
    const Motion k2 = rate_of(moved(motion, k1, step_s / 2), sun_and_moon_mps2);
    const Motion k3 = rate_of(moved(motion, k2, step_s / 2), sun_and_moon_mps2);
    const Motion k4 = rate_of(moved(motion, k3, step_s), sun_and_moon_mps2);
    return moved(moved(moved(moved(motion, k1, step_s / 6), k2, step_s / 3), k3, step_s / 3), k4, step_s / 6);
}

SatelliteState unknown_state() {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {{nan, nan, nan}, {nan, nan, nan}, nan, nan};
}

} // namespace

SatelliteState satellite_state(const GlonassEphemeris& e, const GpsTime& time) noexcept {
    const double since_s = time - e.reference;
    if (!(std::abs(since_s) <= farthest_s)) return unknown_state();
    const int steps = static_cast<int>(std::ceil(std::abs(since_s) / longest_step_s));
    Motion motion{e.position_m, e.velocity_mps};
    for (int i = 0; i < steps; ++i) motion = runge_kutta(motion, e.acceleration_mps2, since_s / steps);
    return {motion.position_m, motion.velocity_mps, e.clock_s + e.clock_drift * since_s, e.clock_drift};
}

} // namespace locus::gnss
