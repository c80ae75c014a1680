// DJI RoboMaster UWB tag module on CAN (protocols.md 1(e), RM): 22 bytes little-endian in frames of 8, 8 and 6 with one
// identifier: x, y (i16 cm), yaw (u16), six distances (i16 cm), error bits, reserved. Only the distances are used:
// where the module's anchors stand, and so its x and y, is not known here. No checksum.
#pragma once

#include "drivers/can_frame.h"
#include "drivers/decoder.h"

namespace locus::uwb {

inline constexpr std::size_t robomaster_record_size = 22;

struct RobomasterRecord {
    std::int16_t x_cm = 0;
    std::int16_t y_cm = 0;
    std::uint16_t yaw = 0; ///< sources disagree on its unit
    std::array<std::int16_t, 6> distance_cm{};
    std::uint16_t error = 0;

    bool operator==(const RobomasterRecord&) const = default;
};

struct RobomasterSettings {
    int id = 0x259;
    int tag = 0;
    int anchor_offset = 0;
};

inline constexpr std::array robomaster_options{
    option<&RobomasterSettings::id>("id", "", 0, 0x7FF, "The module's 11-bit identifier."),
    option<&RobomasterSettings::tag>("tag", "", 0, 65535, "Address given to the module, which does not tell its own."),
    option<&RobomasterSettings::anchor_offset>("anchor_offset", "", 0, 65535,
                                               "Added to the number of an anchor, 0 to 5, to make its address."),
};

RobomasterRecord parse_robomaster_record(std::span<const std::uint8_t, robomaster_record_size> bytes);
std::array<CanFrame, 3> encode(const RobomasterRecord& record, const RobomasterSettings& settings);

/// Gives one Range per distance above zero, stamped with the first frame of the record.
std::unique_ptr<Decoder> make_robomaster_can(const void* settings);

} // namespace locus::uwb
