// What somebody whom a camera sees teaches of the radio map: how strongly a beacon is heard where he stands.
#pragma once

#include "fusion/radio/radio_map.h"

#include <array>
#include <cstdint>

namespace locus::radio {

struct Lesson {
    /// All that one tag teaches while it is one camera's one track; no number comes twice.
    std::uint64_t course = 0;
    bool is_withdrawn = false; ///< the name was wrong: the course is to be forgotten, the rest says nothing
    std::array<double, 2> position_site_m{};
    Reading reading;
};

} // namespace locus::radio
