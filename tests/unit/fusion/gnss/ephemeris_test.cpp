// Broadcast words into ephemerides: what is damaged or does not belong together gives none. That the fields are right
// is told by rtklib (tests/replay/ephemeris_oracle_test.cpp).
#include "fusion/gnss/beidou_d1.h"
#include "fusion/gnss/ephemeris_collector.h"
#include "fusion/gnss/galileo_inav.h"
#include "fusion/gnss/glonass_strings.h"
#include "fusion/gnss/lnav.h"
#include "fusion/gnss/message_fields.h"
#include "tests/allocations.h"
#include "tests/support/navigation_words.h"

#include <gtest/gtest.h>

#include <random>

namespace locus::gnss {
namespace {

using Bits = MessageBits;
using Words = std::vector<std::uint32_t>;

Words listed(const auto& words) { return Words(words.begin(), words.end()); }

constexpr GpsTime now{2381, 408600};
constexpr double pi = 3.1415926535898;

/// `size` bits, all zero but for what makes them a subframe.
Bits lnav(unsigned number, unsigned issue = 7) {
    Bits bits = Bits(240).set(0, 8, 0x8B).set(24, 17, 68100 + number).set(43, 3, number);
    if (number == 1) bits.set(48, 10, 2381 % 1024).set(168, 8, issue).set(176, 16, 410400 / 16);
    if (number == 2) bits.set(48, 8, issue).set(216, 16, 410400 / 16);
    if (number == 3) bits.set(216, 8, issue);
    return bits;
}
Bits inav(unsigned type, unsigned issue = 7) {
    Bits bits = Bits(128).set(0, 6, type);
    if (type <= 4) bits.set(6, 10, issue);
    if (type == 1) bits.set(16, 14, 408000 / 60);
    if (type == 4) bits.set(16, 6, 11).set(54, 14, 408000 / 60);
    if (type == 5) bits.set(73, 12, 1357).set(85, 20, 408600);
    return bits;
}
Bits d1(unsigned number, unsigned sent_s = 408600) {
    constexpr unsigned toe = 406800 / 8;
    Bits bits = Bits(224).set(0, 11, 0b11100010010).set(15, 3, number).set(18, 20, sent_s + 6 * (number - 1));
    if (number == 1) bits.set(48, 13, 1025).set(61, 17, toe);
    if (number == 2) bits.set(222, 2, toe >> 15);
    if (number == 3) bits.set(38, 15, toe & 0x7FFF);
    return bits;
}
Bits glonass(unsigned number, unsigned satellite = 9) {
    Bits bits = Bits(85).set(1, 4, number);
    if (number == 2) bits.set(9, 7, 82);
    if (number == 4) bits.set(70, 5, satellite);
    return bits;
}

TEST(Ephemeris, EveryBrokenBitIsNoticed) {
    const auto refused = [](const Words& words, std::size_t bits_per_word, const auto& good) {
        EXPECT_TRUE(good(words));
        for (std::size_t word = 0; word < words.size(); ++word)
            for (std::size_t bit = 0; bit < bits_per_word; ++bit) {
                Words damaged = words;
                damaged[word] ^= 1u << bit;
                if (good(damaged)) return ADD_FAILURE() << "word " << word << ", bit " << bit;
            }
    };
    std::mt19937 random{7};
    const auto mixed = [&](Bits bits, std::size_t from) {
        for (std::size_t i = from; i < bits.size(); ++i) bits.set(i, 1, static_cast<std::uint32_t>(random() >> 9));
        return bits;
    };
    refused(listed(lnav_words(mixed(lnav(4), 48))), 30, [](const Words& w) { return lnav_subframe(w).has_value(); });
    const Words string = listed(glonass_words(mixed(glonass(5), 5), 0));
    refused({string[0], string[1]}, 32,
            [&](const Words& w) { return glonass_string(Words{w[0], w[1], string[2]}).has_value(); });
    const Words page = listed(inav_words(mixed(inav(1), 6)));
    refused({page[0], page[1], page[2]}, 32, [&](const Words& w) {
        return inav_word(Words{w[0], w[1], w[2], page[3], page[4], page[5], page[6], page[7]}).has_value();
    });
    const Words subframe = listed(d1_words(mixed(d1(4), 38)));
    refused(Words(subframe.begin() + 1, subframe.end()), 30, [&](Words w) {
        w.insert(w.begin(), subframe[0]);
        return d1_subframe(w).has_value();
    });
}

TEST(Ephemeris, WrongNumbersOfWordsAreNothing) {
    for (std::size_t count = 0; count <= 16; ++count) {
        const Words words(count, 0x22C0502E);
        EXPECT_FALSE(lnav_subframe(words) || d1_subframe(words) || inav_word(words)) << count;
        EXPECT_FALSE(count < 3 && glonass_string(words)) << count;
    }
    EXPECT_FALSE(inav_word(Words(8))) << "two even parts";
}

class Collect : public testing::Test {
  protected:
    EphemerisCollector collector;

    std::optional<Ephemeris> add(std::uint8_t constellation, std::span<const std::uint32_t> words,
                                 std::uint8_t satellite = 11) {
        return collector.add(test::navigation(constellation, satellite, 0, words, 9), now);
    }
    std::optional<Ephemeris> lnav_part(unsigned number, unsigned issue = 7) {
        return add(constellation::gps, lnav_words(lnav(number, issue)));
    }
};

TEST_F(Collect, PartsInAnyOrder) {
    EXPECT_FALSE(lnav_part(3));
    EXPECT_FALSE(lnav_part(5));
    EXPECT_FALSE(lnav_part(1));
    const auto ephemeris = lnav_part(2);
    ASSERT_TRUE(ephemeris);
    const auto& e = std::get<KeplerEphemeris>(*ephemeris);
    EXPECT_EQ(e.constellation, constellation::gps);
    EXPECT_EQ(e.satellite, 11);
    EXPECT_EQ(e.issue, 7);
    EXPECT_EQ(e.week, 2381);
    EXPECT_EQ(e.toe_s, 410400);
    EXPECT_EQ(e.toc_s, 410400);
}

TEST_F(Collect, PartsOfTwoIssuesAreNotMixed) {
    EXPECT_FALSE(lnav_part(1, 7));
    EXPECT_FALSE(lnav_part(2, 8));
    EXPECT_FALSE(lnav_part(3, 8));
    EXPECT_TRUE(lnav_part(1, 8));
}

TEST_F(Collect, PartsOfTwoSatellitesAreNotMixed) {
    EXPECT_FALSE(lnav_part(1));
    EXPECT_FALSE(lnav_part(2));
    EXPECT_FALSE(add(constellation::gps, lnav_words(lnav(3)), 12));
    EXPECT_FALSE(add(constellation::qzss, lnav_words(lnav(3)), 10));
    EXPECT_TRUE(lnav_part(3));
}

TEST_F(Collect, Galileo) {
    for (unsigned type = 1; type <= 4; ++type) EXPECT_FALSE(add(constellation::galileo, inav_words(inav(type))));
    const auto ephemeris = add(constellation::galileo, inav_words(inav(5)));
    ASSERT_TRUE(ephemeris);
    EXPECT_EQ(std::get<KeplerEphemeris>(*ephemeris).week, 1357);
    EXPECT_EQ(std::get<KeplerEphemeris>(*ephemeris).toe_s, 408000);
    EXPECT_FALSE(add(constellation::galileo, inav_words(inav(1, 8))));
    for (unsigned type = 2; type <= 5; ++type) EXPECT_FALSE(add(constellation::galileo, inav_words(inav(type))));
}

TEST_F(Collect, Beidou) {
    EXPECT_FALSE(add(constellation::beidou, d1_words(d1(1))));
    EXPECT_FALSE(add(constellation::beidou, d1_words(d1(2))));
    EXPECT_FALSE(add(constellation::beidou, d1_words(d1(3, 408630)))) << "of the next frame";
    const auto ephemeris = add(constellation::beidou, d1_words(d1(3)));
    ASSERT_TRUE(ephemeris);
    EXPECT_EQ(std::get<KeplerEphemeris>(*ephemeris).week, 1025);
    EXPECT_EQ(std::get<KeplerEphemeris>(*ephemeris).toe_s, 406800);
    for (unsigned number = 1; number <= 3; ++number)
        EXPECT_FALSE(add(constellation::beidou, d1_words(d1(number)), 3)) << "geostationary ones send D2";
}

TEST_F(Collect, Glonass) {
    const auto part = [&](unsigned number, unsigned frame) {
        return add(constellation::glonass, glonass_words(glonass(number), frame), 9);
    };
    for (unsigned number = 1; number <= 3; ++number) EXPECT_FALSE(part(number, 1));
    EXPECT_FALSE(part(4, 2)) << "of the next frame";
    for (unsigned number = 1; number <= 2; ++number) EXPECT_FALSE(part(number, 2));
    const auto ephemeris = part(3, 2);
    ASSERT_TRUE(ephemeris);
    const auto& e = std::get<GlonassEphemeris>(*ephemeris);
    EXPECT_EQ(e.satellite, 9);
    EXPECT_EQ(e.frequency, 2);
    EXPECT_EQ(e.reference - now, 20.5 * 3600 - 3 * 3600 + 18 - (408600 - 4 * 86400)) << "20:30 in Moscow, day 4";
}

TEST_F(Collect, HostileNumbersAreNothing) {
    for (unsigned constellation = 0; constellation < 256; ++constellation)
        for (const unsigned satellite : {0u, 33u, 37u, 64u, 255u}) {
            GnssNavigation from = test::navigation(static_cast<std::uint8_t>(constellation),
                                                   static_cast<std::uint8_t>(satellite), 0, Words(16, ~0u));
            from.word_count = 255;
            EXPECT_FALSE(collector.add(from, now));
        }
}

TEST_F(Collect, AllocatesNothing) {
    std::vector<GnssNavigation> all;
    for (unsigned number = 1; number <= 3; ++number)
        all.push_back(test::navigation(constellation::gps, 11, 0, lnav_words(lnav(number))));
    for (unsigned number = 1; number <= 4; ++number)
        all.push_back(test::navigation(constellation::glonass, 9, 0, glonass_words(glonass(number), 1)));
    int made = 0;
    const test::AllocationCount allocations;
    for (const auto& one : all) made += collector.add(one, now).has_value();
    EXPECT_EQ(allocations.made(), 0u);
    EXPECT_EQ(made, 2);
}

TEST(GnssTime, WeeksAreThoseNearest) {
    EXPECT_EQ(nearest_week(333, 1024, 2381), 2381);
    EXPECT_EQ(nearest_week(1023, 1024, 2048), 2047);
    EXPECT_EQ(nearest_week(0, 1024, 2047), 2048);
    EXPECT_EQ(week_of(0, {100, 604700}), 101);
    EXPECT_EQ(week_of(604784, {100, 100}), 99);
    EXPECT_EQ(week_of(300000, {100, 100}), 100);
    EXPECT_EQ((GpsTime{5, 10} + -20) - (GpsTime{4, 604790}), 0);
}

TEST(MessageBits, AreKeptInOrderAndSetInPlace) {
    MessageBits bits;
    bits.append(0b1011, 4);
    bits.append(0x80000001, 32);
    EXPECT_EQ(bits.get(0, 4), 11u);
    EXPECT_EQ(bits.get(4, 32), 0x80000001u);
    EXPECT_EQ(bits.get(34, 4), 0b0100u) << "beyond the end there are zeros";
    bits.set(2, 4, 0b0110).set(34, 8, 0xFF);
    EXPECT_EQ(bits.get(0, 8), 0b10011000u);
    EXPECT_EQ(bits.get(34, 8), 0b11000000u);
    for (int i = 0; i < 10; ++i) bits.append(~0u, 32);
    EXPECT_EQ(bits.size(), MessageBits::capacity);
}

TEST(MessageFields, SignsAndScales) {
    std::array parts{MessageBits{4}.set(0, 4, 0b1011), MessageBits{32}.set(0, 32, 0x80000001)};
    const FieldReader reader{parts};
    double value = 0;
    reader.scaled(value, {{0, 0, 4}}, 1);
    EXPECT_EQ(value, 22);
    reader.scaled_signed(value, {{0, 0, 4}}, -2, pi);
    EXPECT_EQ(value, -1.25 * pi);
    reader.scaled_magnitude(value, {{0, 0, 4}}, 0, 60);
    EXPECT_EQ(value, -180);
    reader.scaled_signed(value, {{1, 0, 32}}, 0);
    EXPECT_EQ(value, -2147483647);
    reader.scaled_signed(value, {{0, 0, 2}, {1, 30, 2}}, 0);
    EXPECT_EQ(value, -7) << "in two pieces";
}

TEST(MessageFields, WhatHasNoRoomIsToldAndNotWritten) {
    const auto fits = [](auto write) {
        std::array parts{MessageBits{8}};
        FieldWriter writer{parts};
        write(writer);
        return writer.fits();
    };
    EXPECT_TRUE(fits([](auto& w) { w.scaled(255.4, {{0, 0, 8}}, 0); }));
    EXPECT_FALSE(fits([](auto& w) { w.scaled(255.6, {{0, 0, 8}}, 0); }));
    EXPECT_FALSE(fits([](auto& w) { w.scaled(-1, {{0, 0, 8}}, 0); }));
    EXPECT_TRUE(fits([](auto& w) { w.scaled_signed(-128, {{0, 0, 8}}, 0); }));
    EXPECT_FALSE(fits([](auto& w) { w.scaled_signed(128, {{0, 0, 8}}, 0); }));
    EXPECT_TRUE(fits([](auto& w) { w.scaled_magnitude(-127, {{0, 0, 8}}, 0); }));
    EXPECT_FALSE(fits([](auto& w) { w.scaled_magnitude(-128, {{0, 0, 8}}, 0); }));
    EXPECT_FALSE(fits([](auto& w) { w.scaled_signed(std::nan(""), {{0, 0, 8}}, 0); }));
    EXPECT_FALSE(fits([](auto& w) { w.scaled(1e300, {{0, 0, 8}}, -9); }));
}

} // namespace
} // namespace locus::gnss
