#include "fusion/gnss/sight.h"

#include "fusion/geometry/earth.h"
#include "fusion/geometry/vector.h"
#include "fusion/gnss/satellite.h"
#include "fusion/gnss/signals.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace locus::gnss {
namespace {

/// What the satellite's clock does not count of the delay at L1: it is told for L1 with L2 (GPS, QZSS), for E1 with E5b
/// (Galileo's I/NAV), for B3I (BeiDou).
double group_delay_s(const KeplerEphemeris& e) {
    return e.group_delay_s[e.constellation == constellation::galileo ? 1 : 0];
}
double group_delay_s(const GlonassEphemeris& /*e*/) { return 0; }

/// IS-GPS-200, 20.3.3.3.1.3: the upper ends of user range accuracy, over the first of them; BeiDou's index means the
/// same (BDS-SIS-ICD B1I, 5.2.4.5). Galileo states 3.12 m of all its satellites, GLONASS nothing here.
double orbit_times(const KeplerEphemeris& e) {
    constexpr std::array upper_m{2.4, 3.4, 4.85, 6.85, 9.65, 13.65, 24.0, 48.0, 96.0, 192.0, 384.0, 768.0, 1536.0};
    if (e.constellation == constellation::galileo) return 1;
    return upper_m[std::min<std::size_t>(e.accuracy, upper_m.size() - 1)] / upper_m[0];
}
double orbit_times(const GlonassEphemeris& /*e*/) { return 1; }

/// Orbits of all constellations, and clocks as far as their fields reach, with much to spare.
bool is_possible(const SatelliteState& state) {
    constexpr double lowest_m = 1e7, highest_m = 6e7, fastest_mps = 2e4, worst_clock_s = 0.01, worst_drift = 1e-6;
    const double radius_m = vector(state.position_ecef_m).norm();
    return radius_m > lowest_m && radius_m < highest_m && vector(state.velocity_ecef_mps).norm() < fastest_mps &&
           std::abs(state.clock_s) < worst_clock_s && std::abs(state.clock_drift) < worst_drift;
}

/// NaN: no Doppler was measured, or one that no satellite can have.
double rate_mps(const GnssRaw& raw, const SatelliteState& state, double wavelength_m) {
    constexpr double fastest_mps = 1e4;
    const double rate = light_mps * state.clock_drift - wavelength_m * raw.doppler_hz;
    const bool measured = raw.doppler_hz != 0 && std::abs(rate) < fastest_mps;
    return measured ? rate : std::numeric_limits<double>::quiet_NaN();
}

/// The pseudorange is reception by the receiver's clock less sending by the satellite's, so the moment of sending hangs
/// on the satellite's clock alone.
template <class E>
SatelliteState when_it_sent(const E& e, const GnssRaw& raw) {
    const GpsTime by_its_clock = time_of(raw) + -raw.pseudorange_m / light_mps;
    const double clock_s = satellite_state(e, by_its_clock).clock_s;
    return satellite_state(e, by_its_clock + (std::abs(clock_s) < 1 ? -clock_s : 0));
}

} // namespace

bool is_possible_pseudorange(double pseudorange_m) noexcept {
    constexpr double shortest_m = 1.2e7, longest_m = 6e7;
    return pseudorange_m > shortest_m && pseudorange_m < longest_m;
}

// NOLINTNEXTLINE(bugprone-exception-escape): all alternatives are trivial, so the variant never loses its value
std::optional<Sight> sight_of(const GnssRaw& raw, const Ephemeris& ephemeris) noexcept {
    const auto state = std::visit([&](const auto& e) { return when_it_sent(e, raw); }, ephemeris);
    if (!is_possible(state)) return std::nullopt;
    const double delay_s = std::visit([](const auto& e) { return group_delay_s(e); }, ephemeris);
    const double hz = carrier_hz(raw.constellation, raw.glonass_slot), wavelength_m = light_mps / hz;
    Sight sight;
    sight.satellite_ecef_m = vector(state.position_ecef_m);
    sight.velocity_ecef_mps = vector(state.velocity_ecef_mps);
    sight.code_m = raw.pseudorange_m + light_mps * (state.clock_s - delay_s);
    if (raw.carrier_cycles != 0) sight.carrier_m = wavelength_m * raw.carrier_cycles + light_mps * state.clock_s;
    sight.rate_mps = rate_mps(raw, state, wavelength_m);
    sight.carrier_hz = hz;
    sight.reception = {raw.constellation, 0, raw.carrier_to_noise_dbhz, raw.sigma_pseudorange_m,
                       std::visit([](const auto& e) { return orbit_times(e); }, ephemeris)};
    return sight;
}

Eigen::Vector3d turned(const Eigen::Vector3d& ecef, double travel_s) noexcept {
    const double angle = earth_rate_radps * travel_s, c = std::cos(angle), s = std::sin(angle);
    return {c * ecef.x() + s * ecef.y(), c * ecef.y() - s * ecef.x(), ecef.z()};
}

} // namespace locus::gnss
