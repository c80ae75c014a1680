// Settings of a PulsON radio, whatever line it is on.
#pragma once

#include "fusion/option.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace locus::uwb::pulson {

struct PulsonSettings {
    Address tag = address(0);
    bool radio_is_anchor = false;
    bool use_coarse = false;
    std::string responders{};
    double request_timeout_s = 0.2;
    int can_address = 0x80;
    int host_address = 1;
};

/// "101, 0x66": node ids, decimal or hexadecimal. What cannot be read is said in `error`, and nothing is given.
std::vector<std::uint32_t> parse_responders(std::string_view text, std::string& error);

/// What is wrong with settings, for `locus check`; empty when nothing is.
std::string check_pulson(const void* settings);

namespace options {
inline constexpr OptionRow tag = required_option<&PulsonSettings::tag>(
    "tag", "Node id of this radio: the address of the target that carries it (of the anchor, with radio_is_anchor).");
inline constexpr OptionRow radio_is_anchor = option<&PulsonSettings::radio_is_anchor>(
    "radio_is_anchor", "Whether this radio is an anchor and those that it ranges to are carried by targets.");
inline constexpr OptionRow use_coarse = option<&PulsonSettings::use_coarse>(
    "use_coarse", "Whether a coarse range (from signal strength) is taken where there is no precise one.");
inline constexpr OptionRow responders = option<&PulsonSettings::responders>(
    "responders", "Node ids that this radio is told to range to, one after the other, e.g. 101,102,103; empty: it "
                  "ranges by itself (RangeNet), and is only greeted when it is silent.");
inline constexpr OptionRow request_timeout_s = option<&PulsonSettings::request_timeout_s>(
    "request_timeout_s", "s", 0.01, 10, "Wait for a range before the next responder is asked.");
inline constexpr OptionRow host_address =
    option<&PulsonSettings::host_address>("host_address", "", 0, 253, "J1939 address by which this box greets it.");
inline constexpr OptionRow can_address =
    option<&PulsonSettings::can_address>("can_address", "", 0, 253, "J1939 address of the radio.");
} // namespace options

inline constexpr std::array stream_options{options::tag, options::radio_is_anchor, options::use_coarse,
                                           options::responders, options::request_timeout_s};
inline constexpr std::array can_options{options::tag, options::radio_is_anchor, options::use_coarse,
                                        options::can_address, options::host_address};

} // namespace locus::uwb::pulson
