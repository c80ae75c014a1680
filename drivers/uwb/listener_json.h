// Decawave's `listener` of uwb-apps (protocols.md 1(c2)): an anchor that prints every frame it hears with its 40-bit
// time of arrival, one JSON object a line, over USB or UART at 115200 baud (UDP: the same lines):
//
//   {"ts":418793104067,"utime":92619018,"rssi0":"-90.9","pd":"1.374","dlen":10,"d":"c5cbf01c0010c2bf4020"}
//
// A tag's blink gives an Arrival at this listener, under the tag's EUI-64; a clock-calibration packet of the clock
// master a ClockSync between the master, under its EUI-64, and this listener. One that another anchor repeats gives
// nothing: the way it came is not known. With two receivers the first counts. Leave out the accumulator samples
// (`cir`): a line longer than 512 characters is refused.
#pragma once

#include "drivers/decoder.h"
#include "drivers/uwb/ieee802154.h"
#include "drivers/uwb/list.h"

#include <optional>
#include <string>
#include <string_view>

namespace locus::uwb {

struct ListenerReport {
    std::uint64_t received_ticks = 0; ///< of 40 bits, 15.65 ps each
    std::uint32_t clock_us = 0;       ///< of the listener's processor
    float rx_power_dbm = unknown_f;
    float first_path_power_dbm = unknown_f;
    List<std::uint8_t, ieee802154::longest_frame> frame; ///< without FCS
};

/// Reads one line without its end. Empty when it is not one, or its frame has not the length that it tells.
std::optional<ListenerReport> parse_listener_report(std::string_view line);

/// As the listener prints it, with "\r\n"; powers to a tenth of a dB.
std::string encode(const ListenerReport& report);

struct ListenerSettings {
    Address anchor = address(0);
};

inline constexpr std::array listener_options{
    required_option<&ListenerSettings::anchor>("anchor", "Address of this listener, which does not tell its own."),
};

std::unique_ptr<Decoder> make_listener_json(const void* settings);

} // namespace locus::uwb
