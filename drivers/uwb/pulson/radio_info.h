// What a PulsON radio says of itself (protocols.md 3.3): its configuration and its status.
#pragma once

#include "drivers/uwb/pulson/layout.h"

#include <array>
#include <cstdint>

namespace locus::uwb::pulson {

/// RCM_GET_CONFIG_CONFIRM.
struct Config {
    static constexpr std::array<std::uint16_t, 1> types{0x0102};
    std::uint16_t type = types[0];
    std::uint16_t message = 0;
    std::uint32_t node = 0;
    std::uint16_t integration = 0; ///< 2^n pulses a bit: 7 by default
    std::uint8_t antenna = 0;
    std::uint8_t code_channel = 0;
    std::int32_t delay_a_ps = 0;
    std::int32_t delay_b_ps = 0;
    std::uint16_t flags = 0;
    std::uint8_t transmit_gain = 0; ///< 0 to 63
    std::uint8_t persist = 0;
    std::uint32_t timestamp_ms = 0;
    std::uint32_t status = 0;

    static void layout(auto& fields, auto& m) {
        fields(m.type, m.message, m.node, m.integration, m.antenna, m.code_channel, m.delay_a_ps, m.delay_b_ps, m.flags,
               m.transmit_gain, m.persist, m.timestamp_ms, m.status);
    }
    bool operator==(const Config&) const = default;
};

/// RCM_GET_STATUS_INFO_REQUEST.
struct StatusRequest {
    static constexpr std::array<std::uint16_t, 1> types{0xF001};
    std::uint16_t type = types[0];
    std::uint16_t message = 0;

    static void layout(auto& fields, auto& m) { fields(m.type, m.message); }
    bool operator==(const StatusRequest&) const = default;
};

struct Version {
    std::uint8_t major = 0;
    std::uint8_t minor = 0;
    std::uint16_t build = 0;
    bool operator==(const Version&) const = default;
};

/// RCM_GET_STATUS_INFO_CONFIRM.
struct StatusInfo {
    static constexpr std::array<std::uint16_t, 1> types{0xF101};
    std::uint16_t type = types[0];
    std::uint16_t message = 0;
    Version application{};
    Version kernel{};
    std::uint8_t firmware = 0;
    std::uint8_t firmware_year = 0; ///< the date looks like BCD
    std::uint8_t firmware_month = 0;
    std::uint8_t firmware_day = 0;
    std::uint32_t serial = 0;
    std::uint8_t board_revision = 0;
    std::uint8_t self_test = 0;
    std::uint8_t model = 0;
    std::uint8_t pulser = 0;
    std::int32_t temperature_quarter_c = 0;
    std::array<char, 32> package{};
    std::uint32_t status = 0;

    static void layout(auto& fields, auto& m) {
        fields(m.type, m.message, m.application.major, m.application.minor, m.application.build, m.kernel.major,
               m.kernel.minor, m.kernel.build, m.firmware, m.firmware_year, m.firmware_month, m.firmware_day, m.serial,
               m.board_revision, m.self_test, m.model, m.pulser, m.temperature_quarter_c, m.package, m.status);
    }
    bool operator==(const StatusInfo&) const = default;
};

} // namespace locus::uwb::pulson
