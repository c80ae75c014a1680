// LNAV, the navigation message of GPS L1 C/A and of QZSS (IS-GPS-200, section 20.3.3; IS-QZSS-PNT, section 4).
#pragma once

#include "fusion/gnss/ephemeris.h"
#include "fusion/gnss/message_bits.h"

#include <optional>
#include <span>

namespace locus::gnss {

/// The 240 information bits of a subframe from its ten words of 30 bits; empty when the parity of a word (20.3.5.2) or
/// the preamble is wrong.
std::optional<MessageBits> lnav_subframe(std::span<const std::uint32_t> words) noexcept;

/// 1 to 5.
unsigned lnav_subframe_number(const MessageBits& subframe) noexcept;

/// From subframes 1, 2 and 3; empty when they are not of one issue. `near_week`: the GPS week, give or take 500.
std::optional<KeplerEphemeris> lnav_ephemeris(std::span<const MessageBits, 3> subframes, int near_week) noexcept;

/// Subframes 1, 2 and 3 as broadcast one after the other from `sent` on; empty when a value has no room in its field or
/// the issues of clock and orbit are not one. What KeplerEphemeris does not hold (codes on L2, fit interval) is 0.
std::optional<std::array<MessageBits, 3>> encode_lnav(const KeplerEphemeris& ephemeris, const GpsTime& sent) noexcept;

/// Writes what every subframe begins with: preamble, time of week and its number, 1 to 5.
void stamp_lnav(MessageBits& subframe, unsigned number, const GpsTime& sent) noexcept;

/// The words of a subframe, with parity, as u-blox hands them over.
std::array<std::uint32_t, 10> lnav_words(const MessageBits& subframe) noexcept;

} // namespace locus::gnss
