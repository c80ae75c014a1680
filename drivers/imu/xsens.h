// Xsens MTi on a serial line or USB: Xbus messages with MTData2 (protocols.md 4.3). A message is a list of values, each
// with its kind, its number format and its length; a sample is the acceleration and the rate of turn of one message.
// Both are in the sensor's axes, whatever frame of the Earth (ENU, NED, NWU) the message names: that is about
// orientation. The magnetic field is left out: its unit is arbitrary.
#pragma once

#include "drivers/imu/mounting.h"
#include "drivers/wire/bytes.h"

#include <optional>
#include <vector>

namespace locus::imu {

namespace xbus {
inline constexpr std::uint8_t preamble = 0xFA, bus_id = 0xFF, extended_length = 0xFF, mtdata2 = 0x36;

/// Of a value's 16 bits; the number format stands in the bits between.
enum Kind : std::uint16_t {
    packet_counter = 0x1020,
    sample_time_fine = 0x1060,
    pressure = 0x3010,
    acceleration = 0x4020,
    acceleration_high_rate = 0x4040,
    rate_of_turn = 0x8020,
    rate_of_turn_high_rate = 0x8040,
};
inline constexpr std::uint16_t kind_mask = 0xF8F0;

enum class Number : std::uint8_t { float32, fp12_20, fp16_32, float64 };
} // namespace xbus

/// What we take of an MTData2 message.
struct XsensData {
    std::optional<std::uint16_t> packet_counter{};
    std::optional<std::uint32_t> sample_time_fine{}; ///< ticks of 100 us
    std::optional<std::uint32_t> pressure_pa{};
    std::optional<Vec3> acceleration_mps2{}; ///< specific force; at high rate where that alone is sent
    std::optional<Vec3> rate_radps{};

    bool operator==(const XsensData&) const = default;
};

/// The data of an MTData2 message; empty when a length in it is wrong.
std::optional<XsensData> parse_mtdata2(wire::Bytes data);

/// A whole Xbus message.
std::vector<std::uint8_t> encode(const XsensData& data, xbus::Number number = xbus::Number::float32);

struct XsensSettings : MountingSettings {
    double packet_rate_hz = 0;
};

inline constexpr std::array xsens_own_options{
    option<&XsensSettings::packet_rate_hz>(
        "packet_rate_hz", "Hz", 0, 2000,
        "Rate of the messages, to date them by their packet counter where SampleTimeFine is not among the outputs; 0: "
        "then by their reception."),
};
inline constexpr auto xsens_options = joined(mounting_options<XsensSettings>, xsens_own_options);

/// Gives an ImuSample per message that holds both halves, and a Pressure where there is one.
std::unique_ptr<Decoder> make_xsens(const void* settings);

} // namespace locus::imu
