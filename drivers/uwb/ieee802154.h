// IEEE 802.15.4 frames as DW1000 devices send them (protocols.md 1(c)): tag blinks, clock-calibration packets of
// Decawave's CCP service, and data frames with short addresses. Numbers are little-endian; frames are without FCS,
// which with_fcs() and without_fcs() add and take away.
#pragma once

#include "drivers/wire/bytes.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace locus::uwb::ieee802154 {

inline constexpr std::size_t longest_frame = 127; ///< with FCS

/// `C5 seq EUI`, 10 bytes.
struct Blink {
    std::uint8_t sequence = 0;
    std::uint64_t eui = 0;

    bool operator==(const Blink&) const = default;
};

/// A clock master's own time, 30 bytes, or 32 with the offset that came later.
struct ClockCalibration {
    std::uint8_t sequence = 0;
    std::uint64_t eui = 0;
    std::uint16_t short_address = 0;
    std::uint64_t interval_ticks_in_master = 0;
    std::uint64_t sent_ticks_in_master = 0; ///< bits 0 to 39; above them what extends them, bit 63 half a period
    std::uint8_t repetition = 0;            ///< 0: from the master itself, not from one who repeats it
    std::uint8_t repetitions = 0;
    std::optional<std::uint16_t> epoch_offset_us{};

    bool operator==(const ClockCalibration&) const = default;
};

/// `41 88 seq PAN destination source payload`.
struct Data {
    std::uint8_t sequence = 0;
    std::uint16_t pan = 0;
    std::uint16_t destination = 0;
    std::uint16_t source = 0;
    std::span<const std::uint8_t> payload; ///< stands in the frame it was read from

    bool operator==(const Data& other) const;
};

std::optional<Blink> parse_blink(std::span<const std::uint8_t> frame);
std::optional<ClockCalibration> parse_clock_calibration(std::span<const std::uint8_t> frame);
std::optional<Data> parse_data(std::span<const std::uint8_t> frame);

std::vector<std::uint8_t> encode(const Blink& blink);
std::vector<std::uint8_t> encode(const ClockCalibration& packet);
std::vector<std::uint8_t> encode(const Data& data);

/// Empty when the last two bytes are not the frame's CRC-16/KERMIT, lowest first.
std::optional<std::span<const std::uint8_t>> without_fcs(std::span<const std::uint8_t> frame);
std::vector<std::uint8_t> with_fcs(std::vector<std::uint8_t> frame);

} // namespace locus::uwb::ieee802154
