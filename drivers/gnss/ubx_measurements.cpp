#include "drivers/gnss/ubx_measurements.h"

#include <algorithm>
#include <cmath>

namespace locus::gnss::ubx {
namespace {

constexpr std::int32_t quarter_turn_1e7_deg = 900'000'000;
constexpr double whole_turn_deg = 360;
constexpr double week_s = 604800;
constexpr double farthest_m = 1e8; // twice the way to a geostationary satellite

std::uint8_t fix_type(const NavPvt& pvt) {
    if (pvt.carrier_solution() == 2) return gnss_fix_type::carrier_fixed;
    if (pvt.carrier_solution() == 1) return gnss_fix_type::carrier_float;
    if (pvt.differential() && pvt.fix_type == gnss_fix_type::full) return gnss_fix_type::differential;
    return pvt.fix_type;
}

float metres(std::int64_t millimetres) { return static_cast<float>(static_cast<double>(millimetres) * 1e-3); }

} // namespace

bool possible(const NavPvt& pvt) {
    return std::abs(std::int64_t{pvt.latitude_1e7_deg}) <= quarter_turn_1e7_deg &&
           std::abs(std::int64_t{pvt.longitude_1e7_deg}) <= 2 * std::int64_t{quarter_turn_1e7_deg};
}

GnssFix fix_of(const NavPvt& pvt, Address tag) {
    GnssFix fix;
    fix.tag = tag;
    fix.latitude_deg = pvt.latitude_1e7_deg * 1e-7;
    fix.longitude_deg = pvt.longitude_1e7_deg * 1e-7;
    fix.height_ellipsoid_m = pvt.height_ellipsoid_mm * 1e-3;
    const auto [north, east, down] = pvt.velocity_ned_mmps;
    fix.velocity_enu_mps = {metres(east), metres(north), metres(-std::int64_t{down})};
    fix.sigma_horizontal_m = metres(pvt.sigma_horizontal_mm);
    fix.sigma_vertical_m = metres(pvt.sigma_vertical_mm);
    fix.sigma_velocity_mps = metres(pvt.sigma_speed_mmps);
    fix.fix_type = fix_type(pvt);
    fix.satellites = pvt.satellites;
    return fix;
}

bool tells_heading(const RelativePosition& relative) {
    return relative.fix_ok() && relative.way_valid() && relative.base_moves() && relative.heading_valid() &&
           relative.carrier_solution() == 2;
}

Heading heading_of(const RelativePosition& relative, Address tag) {
    Heading heading;
    heading.tag = tag;
    heading.heading_deg = relative.heading_1e5_deg * 1e-5;
    heading.sigma_deg = static_cast<float>(relative.sigma_heading_1e5_deg * 1e-5);
    heading.baseline_m = static_cast<float>(relative.length_cm * 1e-2 + relative.length_rest_1e4_m * 1e-4);
    return heading;
}

bool possible(const Heading& heading) { return heading.heading_deg >= 0 && heading.heading_deg <= whole_turn_deg; }

bool possible(const RawEpoch& epoch) {
    return epoch.receiver_time_s >= -1 && epoch.receiver_time_s <= week_s + 1; // its clock may be off by a little
}

bool possible(const RawSignal& signal) {
    return signal.pseudorange_m > 0 && signal.pseudorange_m < farthest_m && std::isfinite(signal.carrier_cycles) &&
           std::isfinite(signal.doppler_hz);
}

GnssRaw raw_of(const RawEpoch& epoch, const RawSignal& signal, Address tag) {
    GnssRaw raw;
    raw.tag = tag;
    raw.receiver_time_s_in_gps_week = epoch.receiver_time_s;
    raw.gps_week = epoch.gps_week;
    raw.pseudorange_m = signal.pseudorange_m;
    raw.carrier_cycles = signal.carrier_valid() ? signal.carrier_cycles : 0;
    raw.doppler_hz = static_cast<double>(signal.doppler_hz);
    raw.sigma_pseudorange_m = std::ldexp(0.01f, signal.sigma_pseudorange & 15);
    raw.carrier_to_noise_dbhz = static_cast<float>(signal.carrier_to_noise_dbhz);
    // When the receiver sets its clock, every carrier jumps: to who reads lock_s, a lock that begins anew.
    raw.lock_s = epoch.clock_was_reset() || !signal.carrier_valid() ? 0 : metres(signal.lock_ms);
    raw.constellation = signal.constellation;
    raw.satellite = signal.satellite;
    raw.signal = signal.signal;
    raw.glonass_slot = signal.glonass_slot;
    return raw;
}

GnssNavigation navigation_of(const Subframe& subframe, Address tag) {
    GnssNavigation navigation;
    navigation.tag = tag;
    navigation.constellation = subframe.constellation;
    navigation.satellite = subframe.satellite;
    navigation.signal = subframe.signal;
    navigation.glonass_slot = subframe.glonass_slot;
    navigation.word_count = subframe.word_count;
    std::copy_n(subframe.words.begin(), navigation.words.size(), navigation.words.begin());
    return navigation;
}

} // namespace locus::gnss::ubx
