// HM-10 and HM-17 BLE modules that scan for iBeacons (protocols.md 7.4): records of 78 characters, back to back,
// without line ends:
//
//   OK+DISC:4C000215:74278BDAB64445208F0C720EAF059935:FFE0FFE1C5:78A5048CECAC:-053
//   prefix   factory  UUID                             major minor power  MAC  RSSI
#pragma once

#include "drivers/decoder.h"
#include "drivers/wire/bytes.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace locus::radio {

struct Hm10Settings {
    Address receiver = no_address;
    double scan_period_s = 0;
};

inline constexpr std::array hm10_options{
    option<&Hm10Settings::receiver>("receiver", "", -no_limit, no_limit, "Address of this radio.", {}, true),
    option<&Hm10Settings::scan_period_s>("scan_period_s", "s", 0, 60,
                                         "How often the module is told to scan (AT+DISI?); 0: it is only listened to."),
};

struct Hm10Record {
    std::string factory_id = "4C000215"; ///< 8 hex digits; this one: an iBeacon
    std::string uuid;                    ///< 32 hex digits
    std::uint16_t major = 0, minor = 0;
    std::int8_t tx_power_dbm = 0; ///< at 1 m
    std::uint64_t mac = 0;
    int rssi_dbm = 0;
    bool operator==(const Hm10Record&) const = default;
};

/// One record of 78 characters. Empty when it does not fit the grammar.
std::optional<Hm10Record> parse_hm10_record(std::string_view text);
std::string encode(const Hm10Record& record);

std::unique_ptr<Decoder> make_hm10(const void* settings);

} // namespace locus::radio
