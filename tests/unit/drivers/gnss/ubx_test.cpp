#include "drivers/gnss/ubx.h"

#include "drivers/gnss/ubx_messages.h"
#include "tests/examples/decoder_example.h"
#include "tests/unit/drivers/collector.h"
#include "tests/unit/drivers/recording/measurement_gen.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace locus::gnss::ubx {
namespace {

using examples::from_hex;
using test::Collector;
using Bytes = std::vector<std::uint8_t>;

/// protocols.md E-5, REAL: with the sync bytes at the beginning of its payload.
const Bytes real_pvt =
    from_hex("b5 62 01 07 5c 00 08 b5 62 21 e5 07 0c 04 0b 22 3b 37 1a 00 00 00 3c 7b fa ff 03 03 ea 1a d9"
             "28 aa fe dc ee db 1f 30 64 01 00 cd a6 00 00 d3 05 00 00 11 08 00 00 f9 ff ff ff 04 00 00 00"
             "09 00 00 00 08 00 00 00 00 00 00 00 03 01 00 00 80 a8 12 01 65 00 00 00 ee 13 4f 2f 00 00 00"
             "00 00 00 00 00 a7 44");
/// The first signal of a REAL epoch; of its 23 the page prints only this one.
const Bytes real_raw =
    from_hex("00 00 00 00 88 51 0b 41 17 09 12 17 01 01 dc 89 83 f1 60 bf 56 70 74 41 e3 61 5e f8 07 da 9a"
             "41 60 01 b7 43 00 0b 00 00 f4 fb 2b 04 01 06 07 00");
const Bytes real_subframe =
    from_hex("b5 62 02 13 30 00 00 05 00 00 0a 00 02 00 2e 50 c0 22 80 6c d1 92 ed bc 89 17 50 49 ff"
             "98 0f 00 50 3f f0 08 43 28 2a 15 bd 24 27 c7 5b a3 49 c3 c7 2d e0 f4 7f b5 93 f7");

Collector decode(const Bytes& bytes, Timestamp time = {}, Duration byte_time = {}) {
    const UbxSettings settings{address(7)};
    Collector sink;
    make_ubx(&settings)->decode(test::bytes_packet(bytes, time, byte_time), sink);
    return sink;
}

TEST(Ubx, ReadsARealFix) {
    const Collector sink = decode(real_pvt);
    ASSERT_EQ(sink.items.size(), 1u);
    const auto fix = std::get<GnssFix>(sink.items[0].observation);
    EXPECT_EQ(fix.tag, address(7));
    EXPECT_DOUBLE_EQ(fix.latitude_deg, 53.4507228);
    EXPECT_DOUBLE_EQ(fix.longitude_deg, -2.2402855);
    EXPECT_DOUBLE_EQ(fix.height_ellipsoid_m, 91.184);
    EXPECT_EQ(fix.velocity_enu_mps, (Vec3f{0.004f, -0.007f, -0.009f}));
    EXPECT_FLOAT_EQ(fix.sigma_horizontal_m, 1.491f);
    EXPECT_FLOAT_EQ(fix.sigma_vertical_m, 2.065f);
    EXPECT_FLOAT_EQ(fix.sigma_velocity_mps, 0.259f);
    EXPECT_EQ(fix.fix_type, gnss_fix_type::differential);
    EXPECT_EQ(fix.satellites, 26);
}

TEST(Ubx, ReadsEveryFieldOfARealFix) {
    const auto pvt = parse_nav_pvt(payload_of(real_pvt));
    ASSERT_TRUE(pvt);
    EXPECT_EQ(pvt->time_of_week_ms, 560117000u);
    EXPECT_EQ(pvt->year, 2021);
    EXPECT_EQ((std::array{pvt->month, pvt->day, pvt->hour, pvt->minute, pvt->second}),
              (std::array<std::uint8_t, 5>{12, 4, 11, 34, 59}));
    EXPECT_EQ(pvt->nano_ns, -361668);
    EXPECT_EQ(pvt->height_sea_level_mm, 42701);
    EXPECT_EQ(pvt->velocity_ned_mmps, (std::array{-7, 4, 9}));
    EXPECT_EQ(pvt->position_dilution_1e2, 101);
    EXPECT_EQ(encode(*pvt), real_pvt);
}

TEST(Ubx, ReadsARealRawSignal) {
    EXPECT_FALSE(parse_raw_epoch(real_raw)) << "22 of its 23 signals are missing";
    Bytes payload = real_raw;
    payload[11] = 1;
    const auto epoch = parse_raw_epoch(payload);
    ASSERT_TRUE(epoch);
    EXPECT_EQ(epoch->leap_s, 18);
    const auto raws = decode(frame(RawEpoch::id, payload)).all<GnssRaw>();
    ASSERT_EQ(raws.size(), 1u);
    EXPECT_EQ(raws[0].tag, address(7));
    EXPECT_EQ(raws[0].receiver_time_s_in_gps_week, 223793.0);
    EXPECT_EQ(raws[0].gps_week, 2327);
    EXPECT_NEAR(raws[0].pseudorange_m, 21431659.961, 5e-4);
    EXPECT_NEAR(raws[0].carrier_cycles, 112624126.092, 5e-4);
    EXPECT_NEAR(raws[0].doppler_hz, 366.01, 5e-3);
    EXPECT_FLOAT_EQ(raws[0].sigma_pseudorange_m, 0.16f);
    EXPECT_EQ(raws[0].carrier_to_noise_dbhz, 43);
    EXPECT_FLOAT_EQ(raws[0].lock_s, 64.5f);
    EXPECT_EQ(raws[0].constellation, constellation::gps);
    EXPECT_EQ(raws[0].satellite, 11);
    EXPECT_EQ(raws[0].signal, 0);
}

TEST(Ubx, ReadsARealSubframe) {
    const auto words = decode(real_subframe).all<GnssNavigation>();
    ASSERT_EQ(words.size(), 1u);
    EXPECT_EQ(words[0].satellite, 5);
    EXPECT_EQ(words[0].word_count, 10);
    EXPECT_EQ(words[0].words[0], 0x22C0502Eu);
    EXPECT_EQ(words[0].words[0] >> 22, 0x8Bu);
    EXPECT_EQ(words[0].words[9], 0xB57FF4E0u);
    EXPECT_EQ(words[0].words[10], 0u);
}

TEST(Ubx, MakesTheCommandsOfThePage) {
    EXPECT_EQ(frame(NavPvt::id, {}), from_hex("B5 62 01 07 00 00 08 19"));
    EXPECT_EQ(frame(0x0608, from_hex("C8 00 01 00 01 00")), from_hex("B5 62 06 08 06 00 C8 00 01 00 01 00 DE 6A"));
    EXPECT_EQ(frame(0x0601, from_hex("02 15 01")), from_hex("B5 62 06 01 03 00 02 15 01 22 70"));
    EXPECT_EQ(frame(0x068A, from_hex("00 01 00 00 07 00 91 20 01 01 00 21 30 64 00")),
              from_hex("B5 62 06 8A 0F 00 00 01 00 00 07 00 91 20 01 01 00 21 30 64 00 0F 82"));
}

TEST(Ubx, StampIsWhenTheFrameBegan) {
    const Collector sink = decode(real_pvt, timestamp_from_ns(1'000'000), Duration{100});
    ASSERT_EQ(sink.items.size(), 1u);
    EXPECT_EQ(to_ns(sink.items[0].time), 1'000'000 - 100 * 100);
}

NavPvt good_pvt() { return *parse_nav_pvt(payload_of(real_pvt)); }

TEST(Ubx, WhatTheReceiverDoesNotTrustIsNoMeasurement) {
    std::vector<NavPvt> doubtful(5, good_pvt());
    doubtful[0].flags = 0;
    doubtful[1].flags3 = 1;
    doubtful[2].fix_type = 0;
    doubtful[3].fix_type = 5;
    doubtful[4].fix_type = 200;
    for (const NavPvt& pvt : doubtful) {
        const Collector sink = decode(encode(pvt));
        EXPECT_EQ(sink.frames, 1);
        EXPECT_TRUE(sink.items.empty());
        EXPECT_TRUE(sink.refusals.empty());
    }
}

TEST(Ubx, TellsTheKindOfFix) {
    NavPvt pvt = good_pvt();
    const auto kind = [&](std::uint8_t fix_type, std::uint8_t flags) {
        pvt.fix_type = fix_type, pvt.flags = flags;
        return decode(encode(pvt)).all<GnssFix>().at(0).fix_type;
    };
    EXPECT_EQ(kind(1, 1), gnss_fix_type::dead_reckoning);
    EXPECT_EQ(kind(2, 1), gnss_fix_type::flat);
    EXPECT_EQ(kind(3, 1), gnss_fix_type::full);
    EXPECT_EQ(kind(4, 3), gnss_fix_type::with_dead_reckoning);
    EXPECT_EQ(kind(3, 0x43), gnss_fix_type::carrier_float);
    EXPECT_EQ(kind(3, 0x83), gnss_fix_type::carrier_fixed);
}

TEST(Ubx, RefusesPlacesThatAreNotOnEarth) {
    for (const auto& [latitude, longitude] :
         {std::pair{900'000'001, 0}, {INT32_MIN, 0}, {0, 1'800'000'001}, {0, INT32_MIN}}) {
        NavPvt pvt = good_pvt();
        pvt.latitude_1e7_deg = latitude, pvt.longitude_1e7_deg = longitude;
        const Collector sink = decode(encode(pvt));
        EXPECT_EQ(sink.refusals, std::vector{Refusal::out_of_range});
        EXPECT_TRUE(sink.items.empty());
    }
}

constexpr RawSignal good_signal{21431659.961, 112624126.092, 366.01f, 6, 11, 0, 9, 1500, 43, 4, 1, 6, 7, 0};

TEST(Ubx, OfARawSignalOnlyWhatIsValidCounts) {
    std::vector<RawSignal> signals(3, good_signal);
    signals[0].tracking = 2; // no pseudorange
    signals[1].tracking = 1; // no carrier
    const auto raws = decode(encode(RawEpoch{10, 2327}, signals)).all<GnssRaw>();
    ASSERT_EQ(raws.size(), 2u);
    EXPECT_EQ(raws[0].carrier_cycles, 0);
    EXPECT_EQ(raws[0].lock_s, 0);
    EXPECT_EQ(raws[1].carrier_cycles, 112624126.092);
    EXPECT_FLOAT_EQ(raws[1].lock_s, 1.5f);
    EXPECT_EQ(raws[1].glonass_slot, 9);
}

TEST(Ubx, WhereTheDoubtOfHalfACycleBeginsOrEndsTheLockBeginsAnew) {
    RawSignal doubtful = good_signal;
    doubtful.tracking = 3;
    Bytes bytes;
    for (const RawSignal& signal : {doubtful, doubtful, good_signal, good_signal, doubtful, good_signal}) {
        const Bytes one = encode(RawEpoch{10, 2327}, std::array{signal});
        bytes.insert(bytes.end(), one.begin(), one.end());
    }
    std::vector<float> locks_s;
    for (const GnssRaw& raw : decode(bytes).all<GnssRaw>()) {
        locks_s.push_back(raw.lock_s);
        EXPECT_EQ(raw.carrier_cycles, 112624126.092);
    }
    EXPECT_EQ(locks_s, (std::vector<float>{1.5F, 1.5F, 0, 1.5F, 0, 0}));
}

TEST(Ubx, AClockResetBreaksEveryCarrier) {
    const auto raws = decode(encode(RawEpoch{10, 2327, 18, 0, 3}, std::array{good_signal})).all<GnssRaw>();
    ASSERT_EQ(raws.size(), 1u);
    EXPECT_EQ(raws[0].lock_s, 0);
    EXPECT_EQ(raws[0].carrier_cycles, 112624126.092);
}

TEST(Ubx, RefusesImpossibleRawSignalsAndKeepsTheRest) {
    std::vector<RawSignal> signals(6, good_signal);
    signals[0].pseudorange_m = std::nan("");
    signals[1].pseudorange_m = -1;
    signals[2].pseudorange_m = 1e8;
    signals[3].carrier_cycles = HUGE_VAL;
    signals[4].doppler_hz = unknown_f;
    const Collector sink = decode(encode(RawEpoch{10, 2327}, signals));
    EXPECT_EQ(sink.items.size(), 1u);
    EXPECT_EQ(sink.refusals, std::vector(5, Refusal::out_of_range));
    for (const double time_s : {std::nan(""), -2.0, 604802.0}) {
        const Collector none = decode(encode(RawEpoch{time_s, 2327}, std::array{good_signal}));
        EXPECT_TRUE(none.items.empty());
        EXPECT_EQ(none.refusals, std::vector{Refusal::out_of_range});
    }
}

TEST(Ubx, ASubframeTooLongForAMeasurementIsAFrame) {
    const Collector sink = decode(encode(Subframe{3, 20, 6, 0, 19}));
    EXPECT_EQ(sink.frames, 1);
    EXPECT_TRUE(sink.items.empty());
    EXPECT_TRUE(sink.refusals.empty());
}

TEST(Ubx, SpeedOfTheVehicleIsAWheelSpeed) {
    SensorReport report{1000, 3 << 11 | 8, 0, {10u << 24 | 77, 11u << 24 | 12345, 11u << 24 | 0xFFFFFF}, 5};
    const auto speeds = decode(encode(report)).all<WheelSpeed>();
    ASSERT_EQ(speeds.size(), 2u);
    EXPECT_EQ(speeds[0].tag, address(7));
    EXPECT_DOUBLE_EQ(speeds[0].speed_mps, 12.345);
    EXPECT_DOUBLE_EQ(speeds[1].speed_mps, -0.001);
}

TEST(Ubx, RefusesLengthsThatDoNotFit) {
    const std::vector<std::pair<MessageId, std::size_t>> frames{
        {NavPvt::id, 91},           {NavPvt::id, 93},           {NavPvt::id, 0},           {RawEpoch::id, 15},
        {RawEpoch::id, 48},         {Subframe::id, 7},          {Subframe::id, 12},        {SensorReport::id, 12},
        {RelativePosition::id, 63}, {RelativePosition::id, 65}, {RelativePosition::id, 0},
    };
    for (const auto& [id, length] : frames) {
        const Collector sink = decode(frame(id, Bytes(length)));
        EXPECT_EQ(sink.refusals, std::vector{Refusal::malformed}) << std::hex << id << ", " << length;
        EXPECT_EQ(sink.frames, 0);
    }
    EXPECT_EQ(decode(frame(Subframe::id, Bytes{0, 5, 0, 0, 33, 0, 2, 0})).refusals, std::vector{Refusal::malformed});
}

TEST(Ubx, OtherMessagesAreFrames) {
    const Collector sink = decode(frame(0x0135, Bytes(20)));
    EXPECT_EQ(sink.frames, 1);
    EXPECT_TRUE(sink.refusals.empty());
}

TEST(Ubx, ALengthThatNoMessageHasIsNotWaitedFor) {
    Bytes bytes = from_hex("b5 62 01 07 ff ff");
    bytes.insert(bytes.end(), real_pvt.begin(), real_pvt.end());
    const Collector sink = decode(bytes);
    EXPECT_EQ(sink.items.size(), 1u);
    EXPECT_EQ(sink.refusals[0], Refusal::too_long);
}

template <class T>
T any() {
    if constexpr (std::is_floating_point_v<T>)
        return test::any_finite<T>();
    else
        return *rc::gen::arbitrary<T>();
}

template <class... Fields>
void fill(Fields&... fields) {
    ((fields = any<Fields>()), ...);
}

TEST(Ubx, FixesComeBack) {
    EXPECT_TRUE(rc::check([] {
        Bytes payload(92);
        for (auto& byte : payload) fill(byte);
        const auto pvt = parse_nav_pvt(payload);
        RC_ASSERT(pvt.has_value());
        RC_ASSERT(encode(*pvt) == frame(NavPvt::id, payload));
        RC_ASSERT(parse_nav_pvt(payload_of(encode(*pvt))) == pvt);
    }));
}

TEST(Ubx, EpochsComeBack) {
    EXPECT_TRUE(rc::check([] {
        RawEpoch epoch;
        fill(epoch.receiver_time_s, epoch.gps_week, epoch.leap_s, epoch.status, epoch.version, epoch.reserved);
        std::vector<RawSignal> signals(*rc::gen::inRange<std::size_t>(0, 40));
        for (RawSignal& s : signals)
            fill(s.pseudorange_m, s.carrier_cycles, s.doppler_hz, s.constellation, s.satellite, s.signal,
                 s.glonass_slot, s.lock_ms, s.carrier_to_noise_dbhz, s.sigma_pseudorange, s.sigma_carrier,
                 s.sigma_doppler, s.tracking);
        const Bytes whole = encode(epoch, signals);
        epoch.signals = static_cast<std::uint8_t>(signals.size());
        RC_ASSERT(parse_raw_epoch(payload_of(whole)) == epoch);
        for (std::size_t i = 0; i < signals.size(); ++i)
            RC_ASSERT(parse_raw_signal(payload_of(whole), i) == signals[i]);
    }));
}

TEST(Ubx, SubframesAndSensorReportsComeBack) {
    EXPECT_TRUE(rc::check([] {
        Subframe sub;
        fill(sub.constellation, sub.satellite, sub.signal, sub.glonass_slot, sub.channel, sub.version, sub.reserved);
        sub.word_count = *rc::gen::inRange<std::uint8_t>(0, Subframe::max_words + 1);
        for (std::size_t i = 0; i < sub.word_count; ++i) fill(sub.words[i]);
        RC_ASSERT(parse_subframe(payload_of(encode(sub))) == sub);
        SensorReport report;
        fill(report.time_tag, report.flags, report.provider);
        for (std::size_t i = 0; i < report.count(); ++i) fill(report.readings[i]);
        if (report.has_receiver_time_tag()) fill(report.receiver_time_tag);
        RC_ASSERT(parse_sensor_report(payload_of(encode(report))) == report);
    }));
}

} // namespace
} // namespace locus::gnss::ubx
