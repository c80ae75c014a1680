// Xsens MTi on CAN with the identifiers it comes with (protocols.md 4.4): one value a frame, big-endian. The frames of
// one sample go out in the order of their identifiers, so the sample time (0x05) or the group counter (0x06) begins a
// group, and what follows until the next one belongs to it.
#pragma once

#include "drivers/can_frame.h"
#include "drivers/imu/mounting.h"

#include <optional>
#include <vector>

namespace locus::imu {

namespace xsens_can {
enum Id : std::uint32_t {
    error = 0x01,
    warning = 0x02,
    sample_time = 0x05,
    group_counter = 0x06,
    rate_of_turn = 0x32,
    acceleration = 0x34,
    pressure = 0x52,
};
} // namespace xsens_can

struct XsensCanSettings : MountingSettings {
    double sample_time_tick_us = 100;
};

inline constexpr std::array xsens_can_own_options{
    option<&XsensCanSettings::sample_time_tick_us>(
        "sample_time_tick_us", "us", 1, 1000,
        "Unit of the sample time (identifier 0x05). Public sources say both 100 and 1; with the wrong one samples are "
        "dated by their reception."),
};
inline constexpr auto xsens_can_options = joined(mounting_options<XsensCanSettings>, xsens_can_own_options);

/// One sample as it goes over the bus.
struct XsensCanSample {
    std::optional<std::uint32_t> sample_time{}; ///< ticks
    std::uint16_t group_counter = 0;
    Vec3 rate_radps{};
    Vec3 acceleration_mps2{};
    std::optional<double> pressure_pa{};
};

/// Rounded to the steps of the format (2^-9 rad/s, 2^-8 m/s^2, 2^-15 Pa) and held to its limits.
std::vector<CanFrame> encode(const XsensCanSample& sample);

/// Gives an ImuSample per group that holds both halves, and a Pressure where there is one.
std::unique_ptr<Decoder> make_xsens_can(const void* settings);

} // namespace locus::imu
