// Measurement: what a decoder says of one sample. Trivially copyable, at most 128 bytes, so it travels in rings.
// Anything larger (an image) stays in a preallocated pool and goes by index.
// NaN in a sigma_* or *_dbm field means "the device does not say": the settings' figure is used instead.
#pragma once

#include "fusion/time.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <type_traits>
#include <variant>

namespace locus {

using Vec2 = std::array<double, 2>;
using Vec3 = std::array<double, 3>;
using Vec3f = std::array<float, 3>;

inline constexpr float unknown_f = std::numeric_limits<float>::quiet_NaN();
inline constexpr Vec3f unknown_vec3f{unknown_f, unknown_f, unknown_f};
inline constexpr double unknown_d = std::numeric_limits<double>::quiet_NaN();
inline constexpr Vec3 unknown_vec3{unknown_d, unknown_d, unknown_d};

/// The number a device calls itself by: a TREK index, a 16-bit short address or an EUI-64.
enum class Address : std::uint64_t {};
inline constexpr Address no_address{std::numeric_limits<std::uint64_t>::max()};
constexpr Address address(std::uint64_t number) { return Address{number}; }
constexpr std::uint64_t number(Address address) { return static_cast<std::uint64_t>(address); }

enum class LineOfSight : std::uint8_t { unknown, clear, blocked };

/// Two-way range between an anchor and a tag.
struct Range {
    Address anchor = no_address;
    Address tag = no_address;
    double range_m = 0;
    float sigma_m = unknown_f;
    float rx_power_dbm = unknown_f;
    float first_path_power_dbm = unknown_f;
    LineOfSight line_of_sight = LineOfSight::unknown;
};

/// Time difference of arrival as a length: distance(tag, anchor_b) - distance(tag, anchor_a).
struct RangeDifference {
    Address anchor_a = no_address;
    Address anchor_b = no_address;
    Address tag = no_address;
    double difference_m = 0;
    float sigma_m = unknown_f;
    LineOfSight line_of_sight = LineOfSight::unknown;
};

/// A tag's blink heard at an anchor, in that anchor's free-running 40-bit DW1000 clock.
struct Arrival {
    Address anchor = no_address;
    Address tag = no_address;
    std::uint64_t rx_anchor_ticks_in_anchor = 0;
    std::uint32_t sequence = 0;
    float rx_power_dbm = unknown_f;
    float first_path_power_dbm = unknown_f;
};

/// A sync packet from one anchor heard at another, each stamp in its own clock.
struct ClockSync {
    Address transmitter = no_address;
    Address receiver = no_address;
    std::uint64_t tx_transmitter_ticks_in_transmitter = 0;
    std::uint64_t rx_receiver_ticks_in_receiver = 0;
    std::uint32_t sequence = 0;
};

/// Where a target is by its own estimate, and how sure of it: what one walker tells another along with their range.
struct PeerBelief {
    Vec3 position_site_m{};
    std::array<float, 6> covariance_m2{unknown_f}; ///< xx, xy, xz, yy, yz, zz; NaN: nothing is known

    bool known() const { return std::isfinite(covariance_m2[0]); }
};

/// Range between two tags.
struct PeerRange {
    Address tag_a = no_address;
    Address tag_b = no_address;
    double range_m = 0;
    float sigma_m = unknown_f;
    PeerBelief other{}; ///< of the tag at the other end; the engine fills it in, no device or recording does
};

struct ImuSample {
    Address tag = no_address;
    Vec3 specific_force_mps2{};
    Vec3 angular_rate_radps{};
    Vec3f magnetic_field_ut = unknown_vec3f;
};

/// How a person looks: shares of colours (drivers/camera/appearance.h says which), each as its square root in 255ths.
/// Whoever reads them scales their squares to the sum one, so no bytes are wrong. All zero: not known.
using Looks = std::array<std::uint8_t, 24>;

/// Where a camera sees a person touch the floor.
struct FootPoint {
    Address camera = no_address;
    std::uint32_t track = 0;
    Vec2 position_site_m{};
    std::array<float, 3> covariance_m2{}; ///< xx, xy, yy
    float confidence = unknown_f;
    Looks looks{};
};

/// Pose from a visual odometry or SLAM, in its own frame and scale; `segment` changes when tracking restarts.
struct VisualOdometry {
    Address camera = no_address;
    std::uint32_t segment = 0;
    Vec3 position_odometry{};
    std::array<double, 4> orientation_xyzw{0, 0, 0, 1};
    Address tag = no_address; ///< of who wears the camera
};

/// What GnssFix::fix_type says: the numbers of u-blox, and after them the finer ones that receivers tell.
namespace gnss_fix_type {
inline constexpr std::uint8_t none = 0, dead_reckoning = 1, flat = 2, full = 3, with_dead_reckoning = 4;
inline constexpr std::uint8_t differential = 6, carrier_float = 7, carrier_fixed = 8;
} // namespace gnss_fix_type

struct GnssFix {
    Address tag = no_address;
    double latitude_deg = 0;
    double longitude_deg = 0;
    double height_ellipsoid_m = 0;
    Vec3f velocity_enu_mps = unknown_vec3f;
    float sigma_horizontal_m = unknown_f;
    float sigma_vertical_m = unknown_f;
    float sigma_velocity_mps = unknown_f;
    std::uint8_t fix_type = 0;
    std::uint8_t satellites = 0;
};

/// Numbers of u-blox (gnssId), which every GNSS decoder uses.
namespace constellation {
inline constexpr std::uint8_t gps = 0, sbas = 1, galileo = 2, beidou = 3, qzss = 5, glonass = 6;
}

/// One signal of one satellite. Receiver time is GPS week and seconds.
struct GnssRaw {
    Address tag = no_address;
    double receiver_time_s_in_gps_week = 0;
    double pseudorange_m = 0;
    double carrier_cycles = 0; ///< 0: none that can be used
    double doppler_hz = 0;     ///< positive: approaching
    float sigma_pseudorange_m = unknown_f;
    float carrier_to_noise_dbhz = unknown_f;
    float lock_s = 0; ///< the carrier is unbroken since; it fell: a slip
    std::uint16_t gps_week = 0;
    std::uint8_t constellation = 0;
    std::uint8_t satellite = 0;
    std::uint8_t signal = 0;       ///< sigId of u-blox
    std::uint8_t glonass_slot = 0; ///< frequency number + 7
};

/// One satellite's signal of one epoch with all that is known taken out: what a tightly coupled filter takes, of the
/// engine (from GnssRaw and ephemerides) or of a recording that gives corrected data. The satellite is where it was
/// when it sent, in the Earth-fixed frame of the moment of reception (turned by the Earth's rotation during the way),
/// so a filter adds no Sagnac term: pseudorange = |satellite - receiver| + clock of the receiver.
struct SatelliteRange {
    Address tag = no_address;
    Vec3 satellite_ecef_m{};
    Vec3f satellite_velocity_ecef_mps{};
    float range_rate_mps = unknown_f; ///< of the pseudorange, satellite's drift taken out; positive: going away
    double pseudorange_m = 0;         ///< satellite's clock, group delay, ionosphere and troposphere taken out
    double carrier_m = 0;             ///< carrier phase, corrected alike, with its unknown constant; 0: none to be used
    float sigma_m = unknown_f;
    float sigma_rate_mps = unknown_f;
    float carrier_to_noise_dbhz = unknown_f;
    float lock_s = 0;               ///< the carrier is unbroken since; it fell: a slip
    std::uint8_t constellation = 0; ///< each has a receiver clock of its own, but QZSS that of GPS
    std::uint8_t satellite = 0;
    std::uint8_t signal = 0; ///< sigId of u-blox
};

/// One subframe, page or string that a satellite broadcast, in words as u-blox packs them: GPS, QZSS and BeiDou 30 bits
/// low in each, Galileo pages and GLONASS strings from the highest bit of the first word on.
struct GnssNavigation {
    static constexpr std::size_t max_words = 16;

    Address tag = no_address;
    std::uint8_t constellation = 0;
    std::uint8_t satellite = 0;
    std::uint8_t signal = 0;
    std::uint8_t glonass_slot = 0;
    std::uint8_t word_count = 0; ///< as the device says: not to be trusted beyond max_words
    std::array<std::uint32_t, max_words> words{};
};

/// A pseudorange at L1 of a base station: a receiver that stands still and tells where. Of what both hear alike a
/// receiver nearby is freed by it (fusion/gnss/base_stations.h). Reception in GPS time; the week the base does not
/// tell.
struct GnssBaseRange {
    Address base = no_address; ///< number of the station
    double time_s_in_gps_week = 0;
    double pseudorange_m = 0;
    Vec3 antenna_ecef_m = unknown_vec3; ///< NaN: it has not told yet
    float carrier_to_noise_dbhz = unknown_f;
    std::uint8_t constellation = 0;
    std::uint8_t satellite = 0;
    std::uint8_t signal = 0;       ///< sigId of u-blox
    std::uint8_t glonass_slot = 7; ///< frequency number + 7
};

/// Where the line from a vehicle's first GNSS antenna to its second one points, as the receiver of both tells.
struct Heading {
    Address tag = no_address;
    double heading_deg = 0; ///< on the level, clockwise from true north
    float sigma_deg = unknown_f;
    float baseline_m = unknown_f; ///< how far the two are apart by the same measurement
};

struct WheelSpeed {
    Address tag = no_address;
    double speed_mps = 0;
    float sigma_mps = unknown_f;
    float yaw_rate_radps = unknown_f;
    float steering_rad = unknown_f;
};

struct Pressure {
    Address tag = no_address;
    double pressure_pa = 0;
    float temperature_c = unknown_f;
};

/// Height over the site's floor (z = 0): a laser or sonar that looks down, a barometer that was levelled.
struct Height {
    Address tag = no_address;
    double height_site_m = 0;
    float sigma_m = unknown_f;
};

struct SignalStrength {
    Address transmitter = no_address;
    Address receiver = no_address;
    float rssi_dbm = 0;
    float tx_power_dbm = unknown_f; ///< power at 1 m that the beacon announces
    std::uint8_t channel = 0;
    PeerBelief other{}; ///< of a transmitter that is a tag itself, whom a camera sees; the engine fills it in
};

using Observation = std::variant<Range, RangeDifference, Arrival, ClockSync, PeerRange, ImuSample, FootPoint,
                                 VisualOdometry, GnssFix, GnssRaw, WheelSpeed, Pressure, SignalStrength, GnssNavigation,
                                 Height, SatelliteRange, GnssBaseRange, Heading>;

/// Class names on the socket and in recordings, in the variant's order.
inline constexpr std::array<std::string_view, std::variant_size_v<Observation>> observation_names{
    "RANGE",           "RANGE_DIFFERENCE", "ARRIVAL",  "CLOCK_SYNC",      "PEER_RANGE",      "IMU",
    "FOOT_POINT",      "VISUAL_ODOMETRY",  "GNSS_FIX", "GNSS_RAW",        "WHEEL_SPEED",     "PRESSURE",
    "SIGNAL_STRENGTH", "GNSS_NAVIGATION",  "HEIGHT",   "SATELLITE_RANGE", "GNSS_BASE_RANGE", "HEADING"};

struct Measurement {
    Timestamp time;             ///< when the sample was taken
    std::uint32_t sequence = 0; ///< per input, counts what the decoder gave; orders samples of one time
    std::uint16_t input = 0;    ///< index of the input in the settings
    Observation observation;
};

static_assert(std::is_trivially_copyable_v<Measurement> && sizeof(Measurement) <= 128);

} // namespace locus
