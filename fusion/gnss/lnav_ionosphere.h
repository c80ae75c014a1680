// Page 18 of subframe 4 of LNAV: the coefficients of the ionosphere (IS-GPS-200, 20.3.3.5.1.7 and figure 20-1).
#pragma once

#include "fusion/gnss/atmosphere.h"
#include "fusion/gnss/message_bits.h"

#include <optional>
#include <span>

namespace locus::gnss {

/// Empty when the subframe, as lnav_subframe() gives it, is another page. QZSS sends the same page (IS-QZSS-PNT).
std::optional<Klobuchar> lnav_ionosphere(const MessageBits& subframe) noexcept;

/// The page, sent at `sent`; empty when a coefficient has no room in its field.
std::optional<MessageBits> encode_lnav_ionosphere(const Klobuchar& coefficients, const GpsTime& sent) noexcept;

} // namespace locus::gnss
