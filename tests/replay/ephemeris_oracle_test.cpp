// Ephemerides out of broadcast words against Debian's rtklib, field by field to the last digit that it prints: those of
// a recording, and those of messages with random content, for all that the recording has not. Its convbin (2.4.3)
// gives no Galileo ephemeris from UBX; single_point_test checks those by where they put the receiver.
#include "drivers/gnss/ubx.h"
#include "drivers/gnss/ubx_messages.h"
#include "fusion/gnss/beidou_d1.h"
#include "fusion/gnss/glonass_strings.h"
#include "fusion/gnss/lnav.h"
#include "tests/replay/data.h"
#include "tests/replay/gnss_replay.h"
#include "tests/replay/printed_ephemeris.h"
#include "tests/support/navigation_words.h"

#include <gtest/gtest.h>

namespace locus::gnss {
namespace {

using test::random_bits;

void expect_same(const std::map<std::string, Ephemeris>& ours, const test::Records& theirs) {
    for (const auto& [name, ephemeris] : ours) {
        if (!theirs.contains(name)) {
            ADD_FAILURE() << "rtklib has no " << name;
            continue;
        }
        test::expect_same(name, ephemeris, theirs.at(name));
    }
}

Replay decode(std::span<const std::uint8_t> ubx) {
    Replay sink;
    replay(make_ubx, UbxSettings{address(0)}, ubx, sink);
    return sink;
}

TEST(EphemerisOracle, OfARecordingAllFieldsAreRtklibs) {
    const auto log = test::recorded("gnss_imu_walk_drive/walk_0827/gnss_1730.ubx");
    if (!log) GTEST_SKIP() << "no gnss_imu_walk_drive in LOCUS_DATA or ../shared/data";
    if (!test::convbin_installed()) GTEST_SKIP() << "no convbin: apt install rtklib";
    const auto bytes = test::bytes_of(*log);
    auto ours = decode(bytes).ephemerides;
    const auto theirs = test::convbin(bytes);
    const auto count = [&](char letter) {
        return std::count_if(ours.begin(), ours.end(), [&](const auto& one) { return one.first[0] == letter; });
    };
    EXPECT_EQ(count('G'), 4);
    EXPECT_EQ(count('C'), 8);
    EXPECT_EQ(count('E'), 7);
    std::erase_if(ours, [](const auto& one) { return one.first[0] == 'E'; });
    expect_same(ours, theirs);
}

/// A log of messages with random content where the content does not matter.
class RandomLog {
  public:
    explicit RandomLog(unsigned seed) : random_{seed} {}
    const std::vector<std::uint8_t>& bytes() const { return bytes_; }

    void epoch() {
        const ubx::RawSignal signal{2.2e7, 1.1e8, 100, 0, 1, 0, 0, 1000, 40, 4, 1, 6, 3, 0};
        append(encode(ubx::RawEpoch{408600, 2381, 18, 1, 1}, std::array{signal}));
    }

    void lnav(std::uint8_t constellation, std::uint8_t satellite) {
        const auto issue = static_cast<std::uint32_t>(random_() % 256);
        for (unsigned number = 1; number <= 3; ++number) {
            MessageBits bits = random_bits(240, random_).set(0, 8, 0x8B).set(24, 17, 68100 + number).set(43, 3, number);
            if (number == 1) bits.set(48, 10, 2381 % 1024).set(168, 8, issue).set(176, 16, 410400 / 16);
            if (number == 2) bits.set(48, 8, issue).set(216, 16, 410400 / 16);
            if (number == 3) bits.set(216, 8, issue);
            words(constellation, satellite, 0, lnav_words(bits));
        }
    }

    void d1(std::uint8_t satellite) {
        constexpr std::uint32_t toe = 406800 / 8;
        for (unsigned number = 1; number <= 3; ++number) {
            MessageBits bits = random_bits(224, random_).set(0, 11, d1_preamble).set(15, 3, number);
            bits.set(18, 20, 408594 + 6 * number);
            if (number == 1) bits.set(48, 13, 1025).set(61, 17, toe);
            if (number == 2) bits.set(222, 2, toe >> 15);
            if (number == 3) bits.set(38, 15, toe & 0x7FFF);
            words(constellation::beidou, satellite, 0, d1_words(bits));
        }
    }

    void d2(std::uint8_t satellite) {
        constexpr std::uint32_t toe = 406800 / 8;
        for (unsigned page = 1; page <= 10; ++page) {
            MessageBits bits = random_bits(224, random_).set(0, 11, d1_preamble).set(15, 3, 1);
            bits.set(18, 20, 408597 + 3 * page).set(38, 4, page);
            if (page == 1) bits.set(52, 13, 1025).set(65, 17, toe);
            if (page == 5) bits.set(96, 1, 0); // rtklib takes the eccentricity's highest bit for a sign
            if (page == 7) bits.set(68, 17, toe);
            words(constellation::beidou, satellite, 1, d1_words(bits));
        }
    }

    void glonass(std::uint8_t satellite, std::uint8_t slot) {
        for (unsigned number = 1; number <= 4; ++number) {
            MessageBits bits = random_bits(85, random_).set(0, 1, 0).set(1, 4, number);
            if (number == 1) bits.set(9, 5, 20).set(14, 6, 29);
            if (number == 2) bits.set(9, 7, 82); // 20:30 in Moscow
            if (number == 4) bits.set(70, 5, satellite);
            words(constellation::glonass, satellite, 0, glonass_words(bits, 0x105), slot);
        }
    }

  private:
    std::mt19937 random_;
    std::vector<std::uint8_t> bytes_;

    void append(const std::vector<std::uint8_t>& frame) { bytes_.insert(bytes_.end(), frame.begin(), frame.end()); }

    void words(std::uint8_t constellation, std::uint8_t satellite, std::uint8_t signal,
               std::span<const std::uint32_t> words, std::uint8_t slot = 0) {
        ubx::Subframe subframe{constellation, satellite, signal, slot, static_cast<std::uint8_t>(words.size())};
        std::ranges::copy(words, subframe.words.begin());
        append(encode(subframe));
    }
};

TEST(EphemerisOracle, OfRandomMessagesAllFieldsAreRtklibs) {
    if (!test::convbin_installed()) GTEST_SKIP() << "no convbin: apt install rtklib";
    RandomLog log{20261122};
    log.epoch();
    for (std::uint8_t satellite = 1; satellite <= 20; ++satellite) {
        log.lnav(constellation::gps, satellite);
        log.d1(static_cast<std::uint8_t>(satellite + 5));
        log.glonass(satellite, satellite % 14);
        if (satellite <= 7) log.lnav(constellation::qzss, satellite);
        if (satellite <= 5) log.d2(satellite);
    }
    log.epoch();
    const auto ours = decode(log.bytes()).ephemerides;
    EXPECT_EQ(ours.size(), 3 * 20u + 7 + 5);
    expect_same(ours, test::convbin(log.bytes()));
}

} // namespace
} // namespace locus::gnss
