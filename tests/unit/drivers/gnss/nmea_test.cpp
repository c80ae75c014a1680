#include "drivers/gnss/nmea.h"

#include "drivers/gnss/nmea_messages.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace locus::gnss::nmea {
namespace {

using test::Collector;

Collector decode(std::string_view text, NmeaSettings settings = {}) {
    settings.tag = address(7);
    Collector sink;
    make_nmea(&settings)->decode(test::bytes_packet(text), sink);
    return sink;
}

Sentence sentence_of(std::string_view line) {
    const auto parsed = parse_sentence(line, true);
    EXPECT_TRUE(std::holds_alternative<Sentence>(parsed)) << line;
    return std::holds_alternative<Sentence>(parsed) ? std::get<Sentence>(parsed) : Sentence{};
}

/// protocols.md E-5: three receivers, REAL; then what gpsd makes, with two digits of longitude in RMC.
constexpr const char* lea_gga = "$GPGGA,030858.00,4907.85331,N,12243.19743,W,1,03,9.97,516.7,M,-16.7,M,,*6C";
constexpr const char* lea_rmc = "$GPRMC,030858.00,A,4907.85331,N,12243.19743,W,1.049,323.14,100806,,,A*76";
constexpr const char* lea_vtg = "$GPVTG,323.14,T,,M,1.049,N,1.943,K,A*39";
constexpr const char* f9p_gga =
    "$GNGGA,014500.00,4404.1306024,N,12118.8446777,W,2,12,0.49,1129.913,M,-21.350,M,,0278*4C";
constexpr const char* f9p_rmc = "$GNRMC,014500.00,A,4404.1306024,N,12118.8446777,W,0.013,,231221,,,D,V*04";
constexpr const char* f9r_gga = "$GNGGA,231408.00,4503.94632,N,00739.54368,E,5,12,0.82,257.4,M,47.2,M,0.0,0041*64";
constexpr const char* gpsd_gga = "$GPGGA,153152.10,4844.4576300,N,00918.7039680,E,1,00,,263.61,M,46.091,M,,*74";
constexpr const char* gpsd_rmc = "$GPRMC,153152.10,A,4844.4576300,N,0918.7039680,E,1.6173,250.909,300124,2.8,E*5F";

TEST(Nmea, ReadsPositions) {
    const auto lea = parse_gga(sentence_of(lea_gga)), f9p = parse_gga(sentence_of(f9p_gga));
    const auto f9r = parse_gga(sentence_of(f9r_gga)), gpsd = parse_gga(sentence_of(gpsd_gga));
    ASSERT_TRUE(lea && f9p && f9r && gpsd);
    EXPECT_EQ(lea->time_us, (3 * 3600 + 8 * 60 + 58) * 1'000'000ll);
    EXPECT_NEAR(lea->latitude_deg, 49 + 7.85331 / 60, 1e-12);
    EXPECT_NEAR(lea->longitude_deg, -(122 + 43.19743 / 60), 1e-12);
    EXPECT_EQ(lea->quality, 1u);
    EXPECT_EQ(lea->satellites, 3u);
    EXPECT_EQ(lea->horizontal_dilution, 9.97);
    EXPECT_EQ(lea->altitude_sea_level_m, 516.7);
    EXPECT_EQ(lea->geoid_separation_m, -16.7);
    EXPECT_NEAR(f9p->latitude_deg, 44 + 4.1306024 / 60, 1e-12);
    EXPECT_EQ(f9p->altitude_sea_level_m, 1129.913);
    EXPECT_NEAR(f9r->longitude_deg, 7 + 39.54368 / 60, 1e-12);
    EXPECT_EQ(f9r->quality, 5u);
    EXPECT_EQ(gpsd->time_us % 1'000'000, 100'000);
    EXPECT_TRUE(std::isnan(gpsd->horizontal_dilution));
}

TEST(Nmea, ReadsVelocities) {
    const auto lea = parse_rmc(sentence_of(lea_rmc)), f9p = parse_rmc(sentence_of(f9p_rmc));
    const auto gpsd = parse_rmc(sentence_of(gpsd_rmc));
    ASSERT_TRUE(lea && f9p && gpsd);
    EXPECT_TRUE(lea->valid);
    EXPECT_EQ(lea->speed_knots, 1.049);
    EXPECT_EQ(lea->course_deg, 323.14);
    EXPECT_EQ(lea->date_ddmmyy, 100806u);
    EXPECT_EQ(f9p->speed_knots, 0.013);
    EXPECT_TRUE(std::isnan(f9p->course_deg));
    EXPECT_NEAR(gpsd->longitude_deg, 9 + 18.703968 / 60, 1e-12) << "minutes are found from the point";
    const auto vtg = parse_vtg(sentence_of(lea_vtg));
    ASSERT_TRUE(vtg);
    EXPECT_EQ(vtg->course_deg, 323.14);
    EXPECT_EQ(vtg->speed_knots, 1.049);
    EXPECT_EQ(vtg->mode, 'A');
}

std::string gga(std::int64_t time_s, const Gga& rest = {0, 44.5, -121.25, 1, 9, 1.5, 100, -20}) {
    Gga gga = rest;
    gga.time_us = time_s * 1'000'000;
    return encode(gga);
}
std::string rmc(std::int64_t time_s, double speed_knots, double course_deg) {
    return encode(Rmc{time_s * 1'000'000, true, 44.5, -121.25, speed_knots, course_deg, 10125});
}
std::string gst(std::int64_t time_s) { return encode(Gst{time_s * 1'000'000, 3, 4, 5}); }

TEST(Nmea, SentencesOfOneMomentAreOneFix) {
    const auto fixes = decode(rmc(1, 10, 90) + gga(1) + gst(1) + gga(2)).all<GnssFix>();
    ASSERT_EQ(fixes.size(), 1u);
    EXPECT_EQ(fixes[0].tag, address(7));
    EXPECT_DOUBLE_EQ(fixes[0].latitude_deg, 44.5);
    EXPECT_DOUBLE_EQ(fixes[0].longitude_deg, -121.25);
    EXPECT_DOUBLE_EQ(fixes[0].height_ellipsoid_m, 80);
    EXPECT_NEAR(fixes[0].velocity_enu_mps[0], 5.14444, 1e-5);
    EXPECT_NEAR(fixes[0].velocity_enu_mps[1], 0, 1e-5);
    EXPECT_NEAR(fixes[0].sigma_horizontal_m, std::sqrt((9 + 16) / 2.0), 1e-6);
    EXPECT_EQ(fixes[0].sigma_vertical_m, 5);
    EXPECT_EQ(fixes[0].fix_type, gnss_fix_type::full);
    EXPECT_EQ(fixes[0].satellites, 9);
}

TEST(Nmea, AFixGoesOutWithTheLastKindOfSentenceThatCameBefore) {
    const NmeaSettings settings{address(7)};
    const auto decoder = make_nmea(&settings);
    Collector sink;
    const auto count_after = [&](const std::string& line) {
        decoder->decode(test::bytes_packet(line), sink);
        return sink.items.size();
    };
    EXPECT_EQ(count_after(gga(1)), 0u);
    EXPECT_EQ(count_after(rmc(1, 1, 0)), 0u) << "what more will come is not known yet";
    EXPECT_EQ(count_after(gga(2)), 1u);
    EXPECT_EQ(count_after(rmc(2, 1, 0)), 2u) << "that was all in the moment before";
    EXPECT_EQ(count_after(gst(2)), 2u) << "a new kind; this fix has gone";
    EXPECT_EQ(count_after(gga(3)), 2u);
    EXPECT_EQ(count_after(rmc(3, 1, 0)), 2u);
    EXPECT_EQ(count_after(gst(3)), 3u);
    EXPECT_EQ(count_after(gga(4)), 3u);
    EXPECT_EQ(count_after(gga(5)), 4u) << "RMC was lost: the next moment lets it go";
    EXPECT_FALSE(std::isfinite(sink.all<GnssFix>()[3].velocity_enu_mps[0]));
    EXPECT_EQ(sink.all<GnssFix>()[2].sigma_vertical_m, 5);
}

TEST(Nmea, StampIsWhenTheFirstSentenceBegan) {
    const std::string first = rmc(1, 1, 0), text = first + gga(1) + gga(2);
    const NmeaSettings settings{address(7)};
    Collector sink;
    make_nmea(&settings)->decode(test::bytes_packet(text, timestamp_from_ns(1'000'000), Duration{100}), sink);
    ASSERT_EQ(sink.items.size(), 1u);
    EXPECT_EQ(to_ns(sink.items[0].time), 1'000'000 - 100 * static_cast<std::int64_t>(text.size()));
}

TEST(Nmea, VelocityOfVtgOnlyWithoutRmc) {
    const std::string vtg = encode(Vtg{0, 20, 'A'});
    const auto north = [](const Collector& sink) { return sink.all<GnssFix>().at(0).velocity_enu_mps[1]; };
    EXPECT_NEAR(north(decode(gga(1) + vtg + gga(2))), 20 * 0.514444, 1e-4);
    EXPECT_NEAR(north(decode(gga(1) + rmc(1, 10, 0) + vtg + gga(2))), 10 * 0.514444, 1e-4);
    EXPECT_TRUE(std::isnan(north(decode(gga(1) + encode(Vtg{0, 20, 'N'}) + gga(2)))));
    EXPECT_TRUE(std::isnan(north(decode(gga(1) + rmc(1, 0.01, not_told) + gga(2))))) << "no course at a standstill";
}

/// A vessel's receiver, REAL; then as THS.
constexpr const char* real_hdt = "$GPHDT,232.39,T*0C\r\n";

TEST(Nmea, HeadingsAreDatedByTheirReception) {
    const std::string text = real_hdt + encode(Ths{51.25, 'A'});
    const NmeaSettings settings{address(7)};
    Collector sink;
    make_nmea(&settings)->decode(test::bytes_packet(text, timestamp_from_ns(1'000'000), Duration{100}), sink);
    const auto headings = sink.all<Heading>();
    ASSERT_EQ(headings.size(), 2u);
    EXPECT_EQ(headings[0].tag, address(7));
    EXPECT_DOUBLE_EQ(headings[0].heading_deg, 232.39);
    EXPECT_TRUE(std::isnan(headings[0].sigma_deg));
    EXPECT_TRUE(std::isnan(headings[0].baseline_m));
    EXPECT_DOUBLE_EQ(headings[1].heading_deg, 51.25);
    EXPECT_EQ(to_ns(sink.items[0].time), 1'000'000 - 100 * static_cast<std::int64_t>(text.size()));
}

TEST(Nmea, HeadingsThatNobodyMeasuredAreNone) {
    for (const char mode : {'E', 'M', 'S', 'V', '\0'}) {
        const Collector sink = decode(encode(Ths{51.25, mode}));
        EXPECT_EQ(sink.frames, 1) << mode;
        EXPECT_TRUE(sink.items.empty() && sink.refusals.empty()) << mode;
    }
    EXPECT_TRUE(decode(encode(Hdt{})).items.empty());
    EXPECT_TRUE(decode(encode(Hdt{})).refusals.empty());
    EXPECT_EQ(decode(encode(Hdt{360.5})).refusals, std::vector{Refusal::out_of_range});
    EXPECT_EQ(decode(encode(Hdt{-1})).refusals, std::vector{Refusal::out_of_range});
    EXPECT_EQ(decode(framed("GNTHS,12x,A")).refusals, std::vector{Refusal::malformed});
}

TEST(Nmea, WithoutGstTheDilutionTellsTheSigma) {
    const auto sigmas = decode(gga(1) + gga(2), {address(7), true, 4}).all<GnssFix>();
    ASSERT_EQ(sigmas.size(), 2u);
    EXPECT_NEAR(sigmas[0].sigma_horizontal_m, 1.5 * 4 / std::sqrt(2), 1e-6);
    EXPECT_NEAR(sigmas[0].sigma_vertical_m, 2.03 * 1.5 * 4 / std::sqrt(2), 0.01);
    const auto none = decode(gga(1, {0, 44, 7, 1, 9, not_told, 100, 0}) + gga(2)).all<GnssFix>();
    ASSERT_EQ(none.size(), 2u);
    EXPECT_TRUE(std::isnan(none[0].sigma_horizontal_m));
}

TEST(Nmea, WithoutTheGeoidTheAltitudeStandsWithAWideSigma) {
    const auto fixes = decode(gga(1, {0, 44, 7, 1, 9, 1, 100, not_told}) + gst(1) + gga(2)).all<GnssFix>();
    ASSERT_EQ(fixes.size(), 1u);
    EXPECT_EQ(fixes[0].height_ellipsoid_m, 100);
    EXPECT_NEAR(fixes[0].sigma_vertical_m, 55.9, 0.1);
}

TEST(Nmea, WhatTheReceiverDoesNotTrustIsNoMeasurement) {
    for (const Gga& doubtful :
         {Gga{0, 44, 7, 0, 9, 1, 100, 0}, Gga{0, 44, 7, 7, 9, 1, 100, 0}, Gga{0, 44, 7, 9, 9, 1, 100, 0},
          Gga{0, not_told, 7, 1, 9, 1, 100, 0}, Gga{0, 44, 7, 1, 9, 1, not_told, 0}}) {
        const Collector sink = decode(gga(1, doubtful) + gga(2, doubtful));
        EXPECT_EQ(sink.frames, 2);
        EXPECT_TRUE(sink.items.empty());
        EXPECT_TRUE(sink.refusals.empty());
    }
    EXPECT_TRUE(decode("$GPGGA,,,,,,0,00,99.99,,,,,,*48\r\n$GPRMC,,V,,,,,,,,,,N*53\r\n").refusals.empty());
}

TEST(Nmea, TellsTheKindOfFix) {
    const auto kind = [](unsigned quality) {
        return decode(gga(1, {0, 44, 7, quality, 9, 1, 100, 0}) + gga(2)).all<GnssFix>().at(0).fix_type;
    };
    EXPECT_EQ(kind(2), gnss_fix_type::differential);
    EXPECT_EQ(kind(3), gnss_fix_type::full);
    EXPECT_EQ(kind(4), gnss_fix_type::carrier_fixed);
    EXPECT_EQ(kind(5), gnss_fix_type::carrier_float);
    EXPECT_EQ(kind(6), gnss_fix_type::dead_reckoning);
    EXPECT_EQ(kind(8), gnss_fix_type::full);
}

TEST(Nmea, SaysWhatIsWrongWithALine) {
    const auto with_sum = [](std::string_view body) { return framed(body); };
    const std::vector<std::pair<std::string, Refusal>> lines{
        {"$GPGGA,030858.00,4907.85331,N,12243.19743,W,1,03,9.97,516.7,M,-16.7,M,,*6D", Refusal::bad_checksum},
        {"$GPGGA,030858.00,4907.85331,N,12243.19743,W,1,03,9.97,516.7,M,-16.7,M,,", Refusal::bad_checksum},
        {"$GPGGA,030858.00*6", Refusal::malformed},
        {"$GPGGA,030858.00*6CC", Refusal::malformed},
        {"$GPGGA*xy", Refusal::malformed},
        {with_sum("GPGGA,030858.00,4960.0,N,12243.1,W,1,03,1,5,M,1,M,,"), Refusal::malformed},
        {with_sum("GPGGA,030858.00,9000.1,N,12243.1,W,1,03,1,5,M,1,M,,"), Refusal::malformed},
        {with_sum("GPGGA,030858.00,4900.1,E,12243.1,W,1,03,1,5,M,1,M,,"), Refusal::malformed},
        {with_sum("GPGGA,030858.00,4900.1,N,18043.1,W,1,03,1,5,M,1,M,,"), Refusal::malformed},
        {with_sum("GPGGA,030858.00,.1,N,12243.1,W,1,03,1,5,M,1,M,,"), Refusal::malformed},
        {with_sum("GPGGA,030858.00,4900.1,,12243.1,W,1,03,1,5,M,1,M,,"), Refusal::malformed},
        {with_sum("GPGGA,240000.00,4900.1,N,12243.1,W,1,03,1,5,M,1,M,,"), Refusal::malformed},
        {with_sum("GPGGA,0308,4900.1,N,12243.1,W,1,03,1,5,M,1,M,,"), Refusal::malformed},
        {with_sum("GPGGA,030858.00,4900.1,N,12243.1,W,1,03,inf,5,M,1,M,,"), Refusal::malformed},
        {with_sum("GPGGA,030858.00,4900.1,N,12243.1,W,1,999,1,5,M,1,M,,"), Refusal::malformed},
        {with_sum("GPGGA,030858.00,4900.1,N,12243.1,W,10,9,1,5,M,1,M,,"), Refusal::malformed},
        {with_sum("GPGGA,030858.00,4900.1,N,12243.1,W,1,9,1,5x,M,1,M,,"), Refusal::malformed},
        {with_sum("GPGSV" + std::string(40, ',')), Refusal::malformed},
        {"!AIVDM,1,1,,B,177KQJ5000G?tO`K>RA1wUbN0TKH,0*5C", Refusal::garbage},
        {std::string(1000, 'x'), Refusal::too_long},
    };
    for (const auto& [line, reason] : lines) {
        const Collector sink = decode(line + "\r\n");
        EXPECT_EQ(sink.refusals, std::vector{reason}) << line;
        EXPECT_EQ(sink.frames, 0) << line;
    }
}

TEST(Nmea, ChecksumsCanBeDoneWithoutButNotWrong) {
    const NmeaSettings settings{address(7), false};
    EXPECT_EQ(decode("$GPGGA,1,2\r\n", settings).refusals, std::vector{Refusal::malformed});
    EXPECT_EQ(decode("$GPGGA,030858.00,4907.85331,N,12243.19743,W,1,03,9.97,516.7,M,-16.7,M,,\r\n", settings).frames,
              1);
    EXPECT_EQ(decode("$GPGGA,030858.00*00\r\n", settings).refusals, std::vector{Refusal::bad_checksum});
}

TEST(Nmea, ARestOfADamagedLineCostsNothing) {
    const Collector sink = decode("$GPGGA,0308" + std::string{lea_gga} + "\r\n" + gga(2));
    EXPECT_EQ(sink.items.size(), 2u);
    EXPECT_TRUE(sink.refusals.empty());
}

TEST(Nmea, OtherSentencesAreFrames) {
    const Collector sink = decode(framed("GPGSV,1,1,00") + framed("PUBX,00,1") + framed("GNTXT,01,01,02,x"));
    EXPECT_EQ(sink.frames, 3);
    EXPECT_TRUE(sink.refusals.empty());
}

TEST(Nmea, ResetForgetsTheMoment) {
    const NmeaSettings settings{address(7)};
    const auto decoder = make_nmea(&settings);
    Collector sink;
    decoder->decode(test::bytes_packet(gga(1) + "$GP"), sink);
    decoder->reset();
    decoder->decode(test::bytes_packet(gga(2)), sink);
    EXPECT_TRUE(sink.items.empty());
    EXPECT_TRUE(sink.refusals.empty());
}

/// A number that the format can hold, or none.
double told_or_not(int most) {
    return *rc::gen::arbitrary<bool>() ? not_told : *rc::gen::inRange(-most * 1000, most * 1000) / 1000.0;
}

bool same(double a, double b) { return std::isnan(a) ? std::isnan(b) : std::abs(a - b) < 1e-9; }

std::int64_t any_time_us() { return *rc::gen::inRange<std::int64_t>(0, 86'400'000'000); }

TEST(Nmea, SentencesComeBack) {
    EXPECT_TRUE(rc::check([] {
        const Gga gga{any_time_us(),
                      told_or_not(90),
                      told_or_not(180),
                      *rc::gen::inRange(0u, 10u),
                      *rc::gen::inRange(0u, 256u),
                      told_or_not(100),
                      told_or_not(9000),
                      told_or_not(100)};
        const std::string line = encode(gga);
        const auto back = parse_gga(sentence_of(std::string_view{line}.substr(0, line.size() - 2)));
        RC_ASSERT(back && back->time_us == gga.time_us && back->quality == gga.quality);
        RC_ASSERT(back->satellites == gga.satellites);
        RC_ASSERT(same(back->latitude_deg, gga.latitude_deg) && same(back->longitude_deg, gga.longitude_deg));
        RC_ASSERT(same(back->horizontal_dilution, gga.horizontal_dilution));
        RC_ASSERT(same(back->altitude_sea_level_m, gga.altitude_sea_level_m));
        RC_ASSERT(same(back->geoid_separation_m, gga.geoid_separation_m));
    }));
    EXPECT_TRUE(rc::check([] {
        const Rmc rmc{
            any_time_us(),    *rc::gen::arbitrary<bool>(),   told_or_not(90), told_or_not(180), told_or_not(900),
            told_or_not(360), *rc::gen::inRange(0u, 311300u)};
        const std::string line = encode(rmc);
        const auto back = parse_rmc(sentence_of(std::string_view{line}.substr(0, line.size() - 2)));
        RC_ASSERT(back && back->time_us == rmc.time_us && back->valid == rmc.valid);
        RC_ASSERT(back->date_ddmmyy == rmc.date_ddmmyy);
        RC_ASSERT(same(back->latitude_deg, rmc.latitude_deg) && same(back->longitude_deg, rmc.longitude_deg));
        RC_ASSERT(same(back->speed_knots, rmc.speed_knots) && same(back->course_deg, rmc.course_deg));
    }));
    EXPECT_TRUE(rc::check([] {
        const Vtg vtg{told_or_not(360), told_or_not(900), *rc::gen::element('A', 'N', '\0')};
        const Gst gst{any_time_us(), told_or_not(90), told_or_not(90), told_or_not(90)};
        const Zda zda{any_time_us(), *rc::gen::inRange(1u, 32u), *rc::gen::inRange(1u, 13u),
                      *rc::gen::inRange(0u, 9999u)};
        const Ths ths{told_or_not(360), *rc::gen::element('A', 'V')};
        const std::string lines[]{encode(vtg), encode(gst), encode(zda), encode(ths)};
        const auto sentence = [&](int i) {
            return sentence_of(std::string_view{lines[i]}.substr(0, lines[i].size() - 2));
        };
        const auto v = parse_vtg(sentence(0));
        const auto g = parse_gst(sentence(1));
        const auto z = parse_zda(sentence(2));
        const auto t = parse_ths(sentence(3));
        RC_ASSERT(t && same(t->heading_deg, ths.heading_deg) && t->mode == ths.mode);
        RC_ASSERT(v && same(v->course_deg, vtg.course_deg) && same(v->speed_knots, vtg.speed_knots) &&
                  v->mode == vtg.mode);
        RC_ASSERT(g && g->time_us == gst.time_us && same(g->sigma_latitude_m, gst.sigma_latitude_m));
        RC_ASSERT(same(g->sigma_longitude_m, gst.sigma_longitude_m) && same(g->sigma_altitude_m, gst.sigma_altitude_m));
        RC_ASSERT(z && z->time_us == zda.time_us && z->day == zda.day && z->month == zda.month && z->year == zda.year);
    }));
}

} // namespace
} // namespace locus::gnss::nmea
