// The CAN nodes of CWRU's mining robot with a DWM1000 each (protocols.md 1(e)), both of their layouts, told apart by
// their length: the older one answers when it is asked, the newer one talks by itself.
#pragma once

#include "drivers/can_frame.h"
#include "drivers/decoder.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

namespace locus::uwb {

struct CwruSettings {
    int node = 1;
    Address tag = no_address;
    int anchor_offset = 0;
    double poll_period_s = 0;
};

inline constexpr std::array cwru_options{
    option<&CwruSettings::node>("node", "", 0, 255, "Number of the node, which is its identifier on the bus."),
    option<&CwruSettings::tag>("tag", "", -no_limit, no_limit, "Address of the target that carries it.", {}, true),
    option<&CwruSettings::anchor_offset>("anchor_offset", "", 0, 65535,
                                         "Added to the number of an anchor to make its address."),
    option<&CwruSettings::poll_period_s>("poll_period_s", "s", 0, 60,
                                         "Time between two questions to a node of the older kind; 0: it is not asked."),
};

struct CwruDistance {
    std::uint8_t anchor = 0;
    float distance_m = 0;
    bool operator==(const CwruDistance&) const = default;
};

/// Empty: another value than a distance, or a length that neither layout has.
std::optional<CwruDistance> parse_cwru(std::span<const std::uint8_t> data);
/// The older layout has 8 bytes, the newer 6.
CanFrame encode(const CwruDistance& distance, int node, bool newer);

std::unique_ptr<Decoder> make_cwru_can(const void* settings);

} // namespace locus::uwb
