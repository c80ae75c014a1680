// Navigation messages for tests: random bits, and words as a decoder hands them over.
#pragma once

#include "fusion/gnss/message_bits.h"
#include "fusion/measurement.h"

#include <algorithm>
#include <random>
#include <span>

namespace locus::test {

inline gnss::MessageBits random_bits(std::size_t size, std::mt19937& random) {
    gnss::MessageBits bits{size};
    for (std::size_t i = 0; i < size; ++i) bits.set(i, 1, static_cast<std::uint32_t>(random() >> 7));
    return bits;
}

inline GnssNavigation navigation(std::uint8_t constellation, std::uint8_t satellite, std::uint8_t signal,
                                 std::span<const std::uint32_t> words, std::uint8_t glonass_slot = 0) {
    GnssNavigation navigation{address(0), constellation, satellite, signal, glonass_slot, {}, {}};
    navigation.word_count = static_cast<std::uint8_t>(words.size());
    std::ranges::copy(words, navigation.words.begin());
    return navigation;
}

} // namespace locus::test
