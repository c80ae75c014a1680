#include "drivers/gnss/rtcm3.h"

#include "drivers/gnss/rtcm3_msm.h"
#include "drivers/gnss/rtcm3_time.h"
#include "tests/examples/decoder_example.h"
#include "tests/support/rtcm3_encoder.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <random>

namespace locus::gnss::rtcm3 {
namespace {

using examples::from_hex;
using test::Collector;
namespace encoder = test::rtcm3;
using encoder::Cell;

/// The example of the standard (RTCM 10403, 4.2), as pyrtcm's documentation prints it.
const encoder::Bytes standard_place =
    from_hex("D3 00 13 3E D7 D3 02 02 98 0E DE EF 34 B4 BD 62 AC 09 41 98 6F 33 36 0B 98");
/// REAL: 1004 of a Unicore receiver, and its 1006 with a place that nobody had set (as hanjuefu5827 printed them on
/// CSDN, article 90112763). The epoch is 127 h 46 min 28 s into the week.
const encoder::Bytes real_1004 = from_hex(
    "D3 00 95 3E C0 01 6D AB 70 80 9B 09 11 38 61 FC E9 23 D2 EE 10 E5 C1 46 FC 3D 20 A5 FC 9F AF EE 11 22 8F A0 88 AE"
    "0D A1 83 72 0D 63 63 F4 7F 30 F8 E4 EB C4 42 30 3F 97 0F 38 79 A3 A3 A7 FB DA 08 A3 66 21 E1 83 0A 60 DC 84 98 BA"
    "B8 00 0E DE 45 4E D1 13 B8 25 DC 06 44 2A A2 D4 30 FE CA 31 CA 16 08 80 20 E0 D4 12 31 A0 2F E3 20 05 47 96 42 D4"
    "44 16 07 34 32 7A 8E B3 43 32 FF 91 90 9A 46 62 1F 50 21 8E 8D C8 78 CF AD 53 FC 1F C5 53 EE 11 3B 41 56 A4 6D 00"
    "66 EA CA");
const encoder::Bytes real_1006 =
    from_hex("D3 00 15 3E E0 01 DC 4E D9 AA 78 90 C0 00 00 00 00 C0 00 00 00 00 00 00 DB 18 1A");

Collector decode_all(const std::vector<encoder::Bytes>& frames) {
    const auto decoder = test::default_decoder("rtcm3");
    Collector sink;
    for (const auto& frame : frames) decoder->decode(test::bytes_packet(frame), sink);
    return sink;
}

std::vector<GnssBaseRange> ranges(const std::vector<encoder::Bytes>& frames) {
    return decode_all(frames).all<GnssBaseRange>();
}

TEST(Rtcm3, ReadsTheStandardsOwnPlace) {
    const auto place = parse_place(message_of(standard_place));
    ASSERT_TRUE(place);
    EXPECT_EQ(place->station, 2003);
    EXPECT_NEAR(place->position_ecef_m[0], 1114104.5999, 1e-7);
    EXPECT_NEAR(place->position_ecef_m[1], -4850729.7108, 1e-7);
    EXPECT_NEAR(place->position_ecef_m[2], 3975521.4643, 1e-7);
    const Collector sink = decode_all({standard_place});
    EXPECT_EQ(sink.frames, 1);
    EXPECT_TRUE(sink.items.empty() && sink.refusals.empty());
}

/// The figures were worked out by hand (Python) from the bits.
TEST(Rtcm3, ReadsRealPseudorangesOfGps) {
    const auto heard = ranges({real_1006, real_1004});
    ASSERT_EQ(heard.size(), 9u);
    const std::array numbers{2, 5, 13, 15, 18, 21, 26, 29, 30};
    const std::array pseudoranges_m{22663491.95, 21410817.038, 23644357.804, 21122979.44, 25142080.254,
                                    24196819.68, 19794148.068, 21853820.076, 23819707.402};
    for (std::size_t i = 0; i < heard.size(); ++i) {
        EXPECT_EQ(heard[i].base, address(1));
        EXPECT_EQ(heard[i].satellite, numbers[i]);
        EXPECT_NEAR(heard[i].pseudorange_m, pseudoranges_m[i], 1e-3);
        EXPECT_EQ(heard[i].time_s_in_gps_week, 459988);
        EXPECT_EQ(heard[i].antenna_ecef_m, (Vec3{6378137, 0, 0}));
    }
    EXPECT_EQ(heard[6].carrier_to_noise_dbhz, 53);
}

TEST(Rtcm3, PseudorangesHaveNoPlaceBeforeTheirOwnStationToldIt) {
    for (const auto& before : {standard_place, encoder::Bytes{}})
        for (const GnssBaseRange& range : ranges({before, real_1004})) EXPECT_TRUE(std::isnan(range.antenna_ecef_m[0]));
}

TEST(Rtcm3, ForgetsThePlaceWhenTheTransportIsOpenedAnew) {
    const auto decoder = test::default_decoder("rtcm3");
    Collector sink;
    decoder->decode(test::bytes_packet(real_1006), sink);
    decoder->reset();
    decoder->decode(test::bytes_packet(real_1004), sink);
    EXPECT_TRUE(std::isnan(sink.all<GnssBaseRange>().at(0).antenna_ecef_m[0]));
}

struct Constellation {
    unsigned number;
    std::uint8_t is;
    std::uint64_t time;
    double gps_s;
};

/// Every kind of every constellation gives what went in, to its own resolution.
TEST(Rtcm3, MultipleSignalMessagesGiveWhatWentIn) {
    const std::array constellations{
        Constellation{1070, constellation::gps, 345'600'123, 345600.123},
        Constellation{1080, constellation::glonass, encoder::glonass_time(4, 10'782'123), 345600.123},
        Constellation{1090, constellation::galileo, 345'600'123, 345600.123},
        Constellation{1110, constellation::qzss, 345'600'123, 345600.123},
        Constellation{1120, constellation::beidou, 345'586'123, 345600.123}};
    for (const Constellation& of : constellations)
        for (const unsigned kind : {4u, 5u, 6u, 7u}) {
            SCOPED_TRACE(of.number + kind);
            const std::vector<Cell> cells{{2, 2, 20123456.789, 44, 9}, {2, 16, 20123460, 40, 9}, {7, 2, 25e6 + 0.3, 0}};
            const auto heard = ranges({encoder::msm(of.number + kind, 99, of.time, cells)});
            ASSERT_EQ(heard.size(), 2u);
            const double resolution_m = (kind < 6 ? 0x1p-24 : 0x1p-29) * 1e-3 * light_mps;
            EXPECT_NEAR(heard[0].pseudorange_m, cells[0].pseudorange_m, 0.51 * resolution_m);
            EXPECT_NEAR(heard[1].pseudorange_m, cells[2].pseudorange_m, 0.51 * resolution_m);
            EXPECT_EQ(heard[0].satellite, 2);
            EXPECT_EQ(heard[1].satellite, 7);
            EXPECT_EQ(heard[0].constellation, of.is);
            EXPECT_EQ(heard[0].carrier_to_noise_dbhz, 44);
            EXPECT_TRUE(std::isnan(heard[1].carrier_to_noise_dbhz));
            EXPECT_NEAR(heard[0].time_s_in_gps_week, of.gps_s, 1e-6);
            const bool tells_slot = of.is == constellation::glonass && kind % 2 == 1;
            EXPECT_EQ(heard[0].glonass_slot, tells_slot ? 9 : 7);
        }
}

TEST(Rtcm3, TakesOfEachSatelliteOneSignalThatTheClockGoesWith) {
    const auto galileo = ranges({encoder::msm(1097, 1, 0, {{4, 4, 2.4e7}, {4, 5, 2.4e7 + 1}, {5, 5, 2.5e7}})});
    ASSERT_EQ(galileo.size(), 2u);
    EXPECT_EQ(galileo[0].signal, 1);
    EXPECT_EQ(galileo[1].signal, 0);
    const auto beidou = ranges({encoder::msm(1127, 1, 0, {{3, 2, 3.8e7}, {30, 2, 2.4e7}})});
    EXPECT_EQ(beidou.at(0).signal, 1) << "geostationary: D2";
    EXPECT_EQ(beidou.at(1).signal, 0);
    EXPECT_TRUE(ranges({encoder::msm(1077, 1, 0, {{3, 4, 2.1e7}})}).empty()) << "P(Y)";
    const auto fallen = ranges({encoder::msm(1097, 1, 0, {{4, 2, 2.4e7, 45, 7, false}, {4, 4, 2.4e7}})});
    ASSERT_EQ(fallen.size(), 1u) << "the first has no pseudorange";
    EXPECT_EQ(fallen[0].signal, 1);
}

TEST(Rtcm3, SkipsOtherMessagesAndRefusesWhatDoesNotFit) {
    encoder::BitWriter text;
    text.put(1029, 12).put(0, 60);
    const Collector other =
        decode_all({text.frame(), frame({}), encoder::msm(1073, 1, 0, {{1}}), encoder::msm(1107, 1, 0, {{1}})});
    EXPECT_EQ(other.frames, 4);
    EXPECT_TRUE(other.refusals.empty() && other.items.empty());
    for (const unsigned number : {1002u, 1004u, 1005u, 1006u, 1074u, 1087u, 1095u, 1116u, 1127u}) {
        encoder::BitWriter cut;
        cut.put(number, 12).put(~0ull, 60).put(~0ull, 64);
        EXPECT_EQ(decode_all({cut.frame()}).refusals, std::vector{Refusal::malformed}) << number;
    }
    EXPECT_EQ(decode_all({encoder::msm(1077, 1, 604'800'000, {{1}})}).refusals, std::vector{Refusal::out_of_range});
    EXPECT_EQ(decode_all({encoder::msm(1087, 1, encoder::glonass_time(7, 0), {{1}})}).refusals,
              std::vector{Refusal::out_of_range});
    EXPECT_EQ(decode_all({encoder::place(1005, 1, {1, 2, 3})}).refusals, std::vector{Refusal::out_of_range});
}

TEST(Rtcm3, GlonassDaysBecomeSecondsOfTheWeek) {
    EXPECT_EQ(gps_second_of_glonass(0, 0), 604800 - 10800 + 18) << "Sunday in Moscow begins on Saturday evening";
    EXPECT_EQ(gps_second_of_glonass(6, 86'400'500), 604800 - 10800 + 18.5 - 0) << "a leap second";
    EXPECT_EQ(gps_second_of_beidou(604'799'000), 13.0);
}

/// Any masks, numbers and lengths with a good checksum: finite, or no place, and never more than a message can hold.
RC_GTEST_PROP(Rtcm3, AnyMessageGivesFiniteRanges, (std::uint32_t seed)) {
    std::mt19937 random{seed};
    constexpr std::array numbers{1002u, 1004u, 1005u, 1006u, 1074u, 1087u, 1097u, 1116u, 1125u};
    encoder::BitWriter bits;
    bits.put(numbers[random() % numbers.size()], 12);
    const auto few = [&] { return random() % 3 == 0 ? random() & random() & random() & random() : 0u; };
    bits.put(random(), 12).put(random() % 604'800'000, 30).put(random(), 19);
    bits.put(few(), 32).put(few(), 32).put(few(), 32);
    const auto length = random() % 900;
    for (std::size_t i = 0; i < length; ++i) bits.put(random(), 8);
    const Collector sink = decode_all({bits.frame()});
    RC_ASSERT(sink.items.size() <= 64u);
    for (const GnssBaseRange& range : sink.all<GnssBaseRange>()) {
        RC_ASSERT(std::isfinite(range.pseudorange_m));
        RC_ASSERT(range.time_s_in_gps_week >= 0 && range.time_s_in_gps_week < week_s);
    }
}

} // namespace
} // namespace locus::gnss::rtcm3
