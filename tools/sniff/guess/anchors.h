// Where frames of an unknown stream might begin: single bytes and pairs that come again and again.
#pragma once

#include "drivers/wire/bytes.h"

#include <cstdint>
#include <vector>

namespace locus::sniff {

struct Anchor {
    std::vector<std::uint8_t> bytes; ///< one or two
    std::vector<std::uint32_t> at;   ///< where they stand, in order
};

/// The most frequent ones; none that comes less than four times. `bytes`: at most 2^31.
std::vector<Anchor> frequent_anchors(wire::Bytes bytes);

} // namespace locus::sniff
