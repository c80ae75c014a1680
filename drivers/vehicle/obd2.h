// OBD-II over CAN: asks the vehicle for its speed and the barometric pressure, one after the other (protocols.md 5.4).
// Every car sold in the last twenty years answers; few answer more than ten times a second.
#pragma once

#include "drivers/can_frame.h"
#include "drivers/decoder.h"

#include <array>
#include <memory>
#include <optional>

namespace locus::vehicle {

struct Obd2Settings {
    Address tag = no_address;
    double poll_period_s = 0.1;
    bool listen_only = false;
};

inline constexpr std::array obd2_options{
    option<&Obd2Settings::tag>("tag", "Address of the target that is the vehicle."),
    option<&Obd2Settings::poll_period_s>("poll_period_s", "s", 0.02, 60,
                                         "Time between two questions; every tenth is for the pressure."),
    option<&Obd2Settings::listen_only>("listen_only", "Whether another program asks, and only answers are read."),
};

enum class Pid : std::uint8_t { speed = 0x0D, barometric_pressure = 0x33 };

/// Mode 01 to all units (identifier 0x7DF).
CanFrame obd2_request(Pid pid);
/// What a unit (identifier 0x7E8 to 0x7EF) answers: one byte, in km/h or kPa.
CanFrame obd2_answer(Pid pid, std::uint8_t value, std::uint32_t unit = 0x7E8);

std::unique_ptr<Decoder> make_obd2(const void* settings);

} // namespace locus::vehicle
