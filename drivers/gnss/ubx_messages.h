// The messages of u-blox receivers that are decoded, field by field as protocols.md 5.1 has them, numbers as on the
// wire. Layout and lengths stand in ubx_messages.cpp, what they mean in ubx.cpp.
#pragma once

#include "drivers/gnss/ubx_frame.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace locus::gnss::ubx {

/// NAV-PVT: the receiver's own position, velocity and time.
struct NavPvt {
    static constexpr MessageId id = 0x0107;

    std::uint32_t time_of_week_ms = 0;
    std::uint16_t year = 0;
    std::uint8_t month = 0, day = 0, hour = 0, minute = 0, second = 0;
    std::uint8_t valid = 0; ///< bits: date, time, fully resolved, magnetic declination
    std::uint32_t sigma_time_ns = 0;
    std::int32_t nano_ns = 0; ///< may be negative: before the second
    std::uint8_t fix_type = 0;
    std::uint8_t flags = 0;
    std::uint8_t flags2 = 0;
    std::uint8_t satellites = 0;
    std::int32_t longitude_1e7_deg = 0;
    std::int32_t latitude_1e7_deg = 0;
    std::int32_t height_ellipsoid_mm = 0;
    std::int32_t height_sea_level_mm = 0;
    std::uint32_t sigma_horizontal_mm = 0;
    std::uint32_t sigma_vertical_mm = 0;
    std::array<std::int32_t, 3> velocity_ned_mmps{};
    std::int32_t ground_speed_mmps = 0;
    std::int32_t course_1e5_deg = 0;
    std::uint32_t sigma_speed_mmps = 0;
    std::uint32_t sigma_course_1e5_deg = 0;
    std::uint16_t position_dilution_1e2 = 0;
    std::uint16_t flags3 = 0;
    std::uint32_t reserved = 0;
    std::int32_t vehicle_heading_1e5_deg = 0;
    std::int16_t declination_1e2_deg = 0;
    std::uint16_t sigma_declination_1e2_deg = 0;

    bool operator==(const NavPvt&) const = default;
    bool time_valid() const { return valid & 2; }
    bool date_and_time_valid() const { return (valid & 3) == 3; }
    bool fix_ok() const { return flags & 1; }
    bool differential() const { return flags & 2; }
    unsigned carrier_solution() const { return flags >> 6; } ///< 1 float, 2 fixed
    bool position_invalid() const { return flags3 & 1; }
};

/// NAV-RELPOSNED, version 1: the way from another antenna to this receiver's. The other is that of a base station, or
/// (moving base) sits on the same vehicle.
struct RelativePosition {
    static constexpr MessageId id = 0x013C;

    std::uint8_t version = 1;
    std::uint8_t reserved = 0;
    std::uint16_t base = 0;
    std::uint32_t time_of_week_ms = 0;
    std::array<std::int32_t, 3> way_ned_cm{};
    std::int32_t length_cm = 0;
    std::int32_t heading_1e5_deg = 0;
    std::uint32_t reserved2 = 0;
    std::array<std::int8_t, 3> way_rest_ned_1e4_m{}; ///< to be added
    std::int8_t length_rest_1e4_m = 0;
    std::array<std::uint32_t, 3> sigma_ned_1e4_m{};
    std::uint32_t sigma_length_1e4_m = 0;
    std::uint32_t sigma_heading_1e5_deg = 0;
    std::uint32_t reserved3 = 0;
    std::uint32_t flags = 0;

    bool operator==(const RelativePosition&) const = default;
    bool fix_ok() const { return flags & 1; }
    bool way_valid() const { return flags & 4; }
    unsigned carrier_solution() const { return flags >> 3 & 3; } ///< 1 float, 2 fixed
    bool base_moves() const { return flags & 32; }
    bool heading_valid() const { return flags & 256; }
};

/// RXM-RAWX: head of an epoch of raw measurements.
struct RawEpoch {
    static constexpr MessageId id = 0x0215;

    double receiver_time_s = 0; ///< in the GPS week
    std::uint16_t gps_week = 0;
    std::int8_t leap_s = 0;
    std::uint8_t signals = 0;
    std::uint8_t status = 0; ///< bits: leap seconds known, clock was reset
    std::uint8_t version = 1;
    std::uint16_t reserved = 0;

    bool operator==(const RawEpoch&) const = default;
    bool clock_was_reset() const { return status & 2; }
};

/// RXM-RAWX: one signal of the epoch.
struct RawSignal {
    double pseudorange_m = 0;
    double carrier_cycles = 0;
    float doppler_hz = 0;
    std::uint8_t constellation = 0, satellite = 0, signal = 0, glonass_slot = 0;
    std::uint16_t lock_ms = 0; ///< stays at 64500
    std::uint8_t carrier_to_noise_dbhz = 0;
    std::uint8_t sigma_pseudorange = 0; ///< low nibble n: 0.01 m * 2^n
    std::uint8_t sigma_carrier = 0;     ///< low nibble: 0.004 cycles each
    std::uint8_t sigma_doppler = 0;     ///< low nibble n: 0.002 Hz * 2^n
    std::uint8_t tracking = 0;
    std::uint8_t reserved = 0;

    bool operator==(const RawSignal&) const = default;
    bool pseudorange_valid() const { return tracking & 1; }
    bool carrier_valid() const { return tracking & 2; }
    bool half_cycle_known() const { return tracking & 4; }
};

/// RXM-SFRBX: words of one subframe, page or string that a satellite broadcasts.
struct Subframe {
    static constexpr MessageId id = 0x0213;
    static constexpr std::size_t max_words = 32; ///< the longest known message (BeiDou B1C) has 19

    std::uint8_t constellation = 0, satellite = 0, signal = 0, glonass_slot = 0;
    std::uint8_t word_count = 0;
    std::uint8_t channel = 0;
    std::uint8_t version = 2;
    std::uint8_t reserved = 0;
    std::array<std::uint32_t, max_words> words{};

    bool operator==(const Subframe&) const = default;
};

/// ESF-MEAS: what sensors of the vehicle told a dead-reckoning receiver.
struct SensorReport {
    static constexpr MessageId id = 0x1002;
    static constexpr std::size_t max_readings = 31;
    static constexpr unsigned speed = 11; ///< type of a reading: speed of the vehicle in mm/s

    std::uint32_t time_tag = 0;
    std::uint16_t flags = 0; ///< bit 3: the receiver's own time tag follows; bits 11 to 15: how many readings
    std::uint16_t provider = 0;
    std::array<std::uint32_t, max_readings> readings{}; ///< type in bits 24 to 29, signed value below
    std::uint32_t receiver_time_tag = 0;

    bool operator==(const SensorReport&) const = default;
    unsigned count() const { return flags >> 11; }
    bool has_receiver_time_tag() const { return flags & 8; }
    unsigned type(std::size_t i) const { return readings[i] >> 24 & 63; }
    std::int32_t value(std::size_t i) const { return static_cast<std::int32_t>(wire::sign_extended(readings[i], 24)); }
};

/// Each reads the payload of its message; empty when the length does not fit, also to a count that stands inside.
std::optional<NavPvt> parse_nav_pvt(wire::Bytes payload);
std::optional<RelativePosition> parse_relative_position(wire::Bytes payload);
std::optional<RawEpoch> parse_raw_epoch(wire::Bytes payload);
/// `index` below the signals of an epoch that parse_raw_epoch() accepted.
RawSignal parse_raw_signal(wire::Bytes payload, std::size_t index);
std::optional<Subframe> parse_subframe(wire::Bytes payload);
std::optional<SensorReport> parse_sensor_report(wire::Bytes payload);

/// Whole frames.
std::vector<std::uint8_t> encode(const NavPvt& pvt);
std::vector<std::uint8_t> encode(const RelativePosition& relative);
/// `signals`: at most 255; their number takes the place of epoch.signals.
std::vector<std::uint8_t> encode(RawEpoch epoch, std::span<const RawSignal> signals);
std::vector<std::uint8_t> encode(const Subframe& subframe);
std::vector<std::uint8_t> encode(const SensorReport& report);

} // namespace locus::gnss::ubx
