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

/// Strings 1 to 4; empty when a value has no room in its field. The time of day is told to the quarter of an hour.
std::optional<std::array<MessageBits, 4>> encode_glonass(const GlonassEphemeris& ephemeris, int leap_s) noexcept;

/// The words of a string, with its check bits, as u-blox hands them over; `frame`: what the receiver counts them by.
std::array<std::uint32_t, 4> glonass_words(MessageBits string, std::uint32_t frame) noexcept;

} // namespace locus::gnss
