// TI Z-Stack's network processor on CC2530, CC2652 (ZNP, protocols.md 7.2): packets from the air with their link
// quality. What a step of link quality is in dBm depends on how the firmware was built and is published nowhere: it is
// a setting that has to be calibrated.
#pragma once

#include "drivers/decoder.h"
#include "drivers/wire/bytes.h"

#include <array>
#include <optional>
#include <vector>

namespace locus::radio {

struct ZnpSettings {
    Address receiver = no_address;
    double lqi_zero_dbm = 0;
    double lqi_step_db = 0;
};

inline constexpr std::array znp_options{
    option<&ZnpSettings::receiver>("receiver", "", -no_limit, no_limit, "Address of this radio.", {}, true),
    option<&ZnpSettings::lqi_zero_dbm>("lqi_zero_dbm", "dBm", -150, 0,
                                       "Strength at link quality 0, calibrated for the firmware.", {}, true),
    option<&ZnpSettings::lqi_step_db>("lqi_step_db", "dB", 0.01, 5,
                                      "Strength of one step of link quality, calibrated for the firmware.", {}, true),
};

/// AF_INCOMING_MSG, as far as it is of use here.
struct ZnpIncoming {
    std::uint16_t cluster = 0;
    std::uint16_t source = 0;
    std::uint8_t link_quality = 0;
    std::uint32_t timestamp = 0;
    bool operator==(const ZnpIncoming&) const = default;
};

/// `frame` from 0xFE to its checksum. Empty when it is another command, or too short.
std::optional<ZnpIncoming> parse_znp_incoming(wire::Bytes frame);
std::vector<std::uint8_t> znp_frame(std::uint8_t command0, std::uint8_t command1, wire::Bytes data);
std::vector<std::uint8_t> encode(const ZnpIncoming& incoming);

std::unique_ptr<Decoder> make_znp(const void* settings);

} // namespace locus::radio
