// The strings that GLONASS satellites send on L1 and L2 (GLONASS ICD, edition 5.1, section 4).
#pragma once

#include "fusion/gnss/ephemeris.h"
#include "fusion/gnss/message_bits.h"

#include <optional>
#include <span>

namespace locus::gnss {

/// The 85 bits of a string, bit 85 first, from three words of 32 bits; empty when its check bits (4.7) are wrong.
std::optional<MessageBits> glonass_string(std::span<const std::uint32_t> words) noexcept;

/// 1 to 15.
unsigned glonass_string_number(const MessageBits& string) noexcept;

/// From strings 1 to 4 of one frame. The strings tell the time of day only: the day is that which brings the reference
/// time closest to `near`. `leap_s`: GPS time less UTC. Empty when the satellite does not tell its number (older ones).
std::optional<GlonassEphemeris> glonass_ephemeris(std::span<const MessageBits, 4> strings, const GpsTime& near,
                                                  int leap_s) noexcept;

} // namespace locus::gnss
