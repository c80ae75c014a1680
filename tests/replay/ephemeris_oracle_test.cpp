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
#include "tests/replay/rinex_oracle.h"
#include "tests/support/navigation_words.h"

#include <gtest/gtest.h>

namespace locus::gnss {
namespace {

using test::random_bits;

/// The numbers of a record in its order; not all are comparable, those are left out as NaN.
std::vector<double> as_printed(const KeplerEphemeris& e) {
    constexpr double skip = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> numbers{e.clock_s,
                                e.clock_drift,
                                e.clock_drift_rate_per_s,
                                static_cast<double>(e.issue),
                                e.crs_m,
                                e.mean_motion_difference,
                                e.mean_anomaly,
                                e.cuc,
                                e.eccentricity,
                                e.cus,
                                e.root_a,
                                e.toe_s,
                                e.cic,
                                e.node,
                                e.cis,
                                e.inclination,
                                e.crc_m,
                                e.perigee,
                                e.node_rate,
                                e.inclination_rate,
                                skip};
    const bool lnav = e.constellation != constellation::beidou;
    numbers.push_back(e.week);
    numbers.insert(numbers.end(), {skip, skip, static_cast<double>(e.health), e.group_delay_s[0]});
    numbers.push_back(lnav ? e.issue_clock : e.group_delay_s[1]);
    return numbers;
}

std::vector<double> as_printed(const GlonassEphemeris& e) {
    std::vector<double> numbers{e.clock_s, e.clock_drift, std::numeric_limits<double>::quiet_NaN()};
    const std::array<double, 3> ends{double(e.health), double(e.frequency), double(e.age_days)};
    for (std::size_t i = 0; i < 3; ++i)
        numbers.insert(numbers.end(),
                       {e.position_m[i] / 1e3, e.velocity_mps[i] / 1e3, e.acceleration_mps2[i] / 1e3, ends[i]});
    return numbers;
}

void expect_same(const std::map<std::string, Ephemeris>& ours, const test::Records& theirs) {
    for (const auto& [name, ephemeris] : ours) {
        if (!theirs.contains(name)) {
            ADD_FAILURE() << "rtklib has no " << name;
            continue;
        }
        const auto numbers = std::visit([](const auto& e) { return as_printed(e); }, ephemeris);
        const auto& record = theirs.at(name);
        ASSERT_GE(record.size(), numbers.size()) << name;
        for (std::size_t i = 0; i < numbers.size(); ++i)
            EXPECT_TRUE(std::isnan(numbers[i]) || record[i].is(numbers[i]))
                << name << ", number " << i << ": " << numbers[i] << ", rtklib " << record[i].value;
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
            MessageBits bits = random_bits(224, random_).set(0, 11, 0b11100010010).set(15, 3, number);
            bits.set(18, 20, 408594 + 6 * number);
            if (number == 1) bits.set(48, 13, 1025).set(61, 17, toe);
            if (number == 2) bits.set(222, 2, toe >> 15);
            if (number == 3) bits.set(38, 15, toe & 0x7FFF);
            words(constellation::beidou, satellite, 0, d1_words(bits));
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
    }
    log.epoch();
    const auto ours = decode(log.bytes()).ephemerides;
    EXPECT_EQ(ours.size(), 3 * 20u + 7);
    expect_same(ours, test::convbin(log.bytes()));
}

} // namespace
} // namespace locus::gnss
