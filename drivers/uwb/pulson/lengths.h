// How long each message of a PulsON radio must be. Over USB there is no checksum: type and length are all that tells a
// message from noise.
#pragma once

#include "drivers/wire/bytes.h"

#include <cstdint>
#include <optional>

namespace locus::uwb::pulson {

inline constexpr std::size_t longest_message = 1500;

/// A message of `fixed` bytes, and where `item` is not 0 of so many bytes more for each of a count that stands inside.
struct LengthRule {
    std::uint16_t type;
    std::uint16_t fixed;
    std::uint16_t item = 0;
    std::uint16_t most = 0;     ///< items
    std::uint16_t count_at = 0; ///< offset of the count
    std::uint16_t count_bytes = 0;

    constexpr bool allows(std::size_t length) const {
        return item == 0 ? length == fixed
                         : length >= fixed && (length - fixed) % item == 0 && (length - fixed) / item <= most;
    }
    /// Whether the whole message is as long as its count says.
    constexpr bool allows(wire::Bytes message) const {
        return allows(message.size()) &&
               (item == 0 || wire::big_bytes(message, count_at, count_bytes) == (message.size() - fixed) / item);
    }
};

/// Of the messages that a radio sends; empty for a type that is not known.
std::optional<LengthRule> length_rule(std::uint16_t type);

} // namespace locus::uwb::pulson
