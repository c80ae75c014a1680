// Navigation messages made from chosen or random bits, as satellites protect them and u-blox hands them over. The
// positions of fields are those of the interface documents, over the information bits alone.
#pragma once

#include "fusion/gnss/message_bits.h"
#include "fusion/measurement.h"

#include <algorithm>
#include <bit>
#include <random>
#include <vector>

namespace locus::test {

/// Bits in a row, to be set field by field.
struct Bits {
    std::vector<bool> bits;

    explicit Bits(std::size_t size) : bits(size) {}
    static Bits random(std::size_t size, std::mt19937& random) {
        Bits made(size);
        for (std::size_t i = 0; i < size; ++i) made.bits[i] = random() >> 7 & 1;
        return made;
    }
    Bits& set(std::size_t begin, std::size_t length, std::uint64_t value) {
        for (std::size_t i = 0; i < length; ++i) bits[begin + i] = value >> (length - 1 - i) & 1;
        return *this;
    }
    std::uint32_t get(std::size_t begin, std::size_t length) const {
        std::uint32_t value = 0;
        for (std::size_t i = begin; i < begin + length; ++i) value = value << 1 | bits[i];
        return value;
    }
};

inline GnssNavigation navigation(std::uint8_t constellation, std::uint8_t satellite, std::uint8_t signal,
                                 const std::vector<std::uint32_t>& words, std::uint8_t glonass_slot = 0) {
    GnssNavigation navigation{address(0), constellation, satellite, signal, glonass_slot, {}, {}};
    navigation.word_count = static_cast<std::uint8_t>(words.size());
    std::copy(words.begin(), words.end(), navigation.words.begin());
    return navigation;
}

/// IS-GPS-200 20.3.5.2 with its equations written out: which data bits each parity bit adds up.
inline std::uint32_t lnav_parity(std::uint32_t data, std::uint32_t before) {
    static const std::vector<std::vector<unsigned>> sums{
        {1, 2, 3, 5, 6, 10, 11, 12, 13, 14, 17, 18, 20, 23},    {2, 3, 4, 6, 7, 11, 12, 13, 14, 15, 18, 19, 21, 24},
        {1, 3, 4, 5, 7, 8, 12, 13, 14, 15, 16, 19, 20, 22},     {2, 4, 5, 6, 8, 9, 13, 14, 15, 16, 17, 20, 21, 23},
        {1, 3, 5, 6, 7, 9, 10, 14, 15, 16, 17, 18, 21, 22, 24}, {3, 5, 6, 8, 9, 10, 11, 13, 15, 19, 22, 23, 24}};
    static const std::array<unsigned, 6> previous{1, 0, 1, 0, 0, 1}; // D29*, D30*
    std::uint32_t parity = 0;
    for (std::size_t i = 0; i < 6; ++i) {
        std::uint32_t sum = before >> previous[i] & 1;
        for (const unsigned d : sums[i]) sum ^= data >> (24 - d) & 1;
        parity = parity << 1 | sum;
    }
    return parity;
}

/// From 240 bits. Of word 10 the last two data bits are chosen so that its parity ends with 00.
inline std::vector<std::uint32_t> lnav_words(const Bits& bits) {
    std::vector<std::uint32_t> words;
    std::uint32_t before = 0;
    for (std::size_t i = 0; i < 10; ++i) {
        std::uint32_t data = bits.get(24 * i, 24);
        for (std::uint32_t tail = 0; i == 9 && tail < 4; ++tail)
            if ((lnav_parity((data & ~3u) | tail, before) & 3) == 0) data = (data & ~3u) | tail;
        const std::uint32_t parity = lnav_parity(data, before);
        const std::uint32_t sent = before << 30 | data << 6 | parity;
        words.push_back(before & 1 ? sent ^ 0xC000003F : sent);
        before = parity & 3;
    }
    return words;
}

inline std::uint32_t crc24q(const Bits& bits) {
    std::uint32_t crc = 0;
    for (const bool bit : bits.bits) {
        crc = crc << 1 ^ (bit ? 1u << 24 : 0);
        if (crc >> 24 & 1) crc ^= 0x1864CFB;
    }
    return crc & 0xFFFFFF;
}

/// From the 128 bits of a word: both parts of a page.
inline std::vector<std::uint32_t> inav_words(const Bits& word) {
    Bits even(128), odd(128), checked(196);
    std::copy_n(word.bits.begin(), 112, even.bits.begin() + 2);
    odd.set(0, 2, 0b10);
    std::copy_n(word.bits.begin() + 112, 16, odd.bits.begin() + 2);
    std::copy_n(even.bits.begin(), 114, checked.bits.begin());
    std::copy_n(odd.bits.begin(), 82, checked.bits.begin() + 114);
    odd.set(82, 24, crc24q(checked));
    std::vector<std::uint32_t> words;
    for (const Bits* part : {&even, &odd})
        for (std::size_t i = 0; i < 4; ++i) words.push_back(part->get(32 * i, 32));
    return words;
}

inline std::uint32_t bch(std::uint32_t data) {
    std::uint32_t rest = data << 4;
    for (unsigned i = 14; i >= 4; --i)
        if (rest >> i & 1) rest ^= 0b10011u << (i - 4);
    return rest;
}

/// From 224 bits.
inline std::vector<std::uint32_t> d1_words(const Bits& bits) {
    std::vector<std::uint32_t> words{bits.get(0, 26) << 4 | bch(bits.get(15, 11))};
    for (std::size_t i = 26; i < 224; i += 22)
        words.push_back(bits.get(i, 22) << 8 | bch(bits.get(i, 11)) << 4 | bch(bits.get(i + 11, 11)));
    return words;
}

/// From 85 bits, of which the last 8 are written here: each check sum of the ICD (4.7) has every bit whose turn it is.
inline std::vector<std::uint32_t> glonass_words(Bits string, std::uint32_t frame) {
    const auto bit = [&](unsigned number) { return string.bits[85 - number]; };
    std::vector<unsigned> places; // of bits 9 to 85
    for (unsigned place = 3; places.size() < 77; ++place)
        if (!std::has_single_bit(place)) places.push_back(place);
    unsigned ones = 0;
    for (unsigned check = 0; check < 7; ++check) {
        unsigned sum = 0;
        for (unsigned i = 0; i < 77; ++i) sum ^= bit(i + 9) && places[i] >> check & 1;
        string.set(84 - check, 1, sum);
    }
    for (unsigned number = 2; number <= 85; ++number) ones += bit(number);
    ones += bit(1);
    ones -= bit(8);
    string.set(77, 1, ones & 1);
    return {string.get(0, 32), string.get(32, 32), string.get(64, 21) << 11, frame << 16};
}

} // namespace locus::test
