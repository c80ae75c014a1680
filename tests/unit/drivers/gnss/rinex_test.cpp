// RINEX files as they come: made here line by line, with all that the format allows and much that it does not.
#include "drivers/gnss/gps_timestamp.h"
#include "drivers/gnss/rinex_navigation.h"
#include "drivers/gnss/rinex_observations.h"
#include "drivers/gnss/rinex_signal.h"
#include "tests/unit/drivers/collector.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace locus::gnss::rinex {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::string headed(std::string_view text, std::string_view what) { return fmt::format("{:<60}{:<20}\n", text, what); }

std::string version(std::string_view number, char type, char system) {
    return headed(fmt::format("{:>9}{:11}{:<20}{:<20}", number, "", std::string(1, type), std::string(1, system)),
                  "RINEX VERSION / TYPE");
}

/// Values of a satellite: number, indicator of lost lock, or nothing.
std::string satellite_line(std::string_view name, const std::vector<std::pair<double, char>>& values) {
    std::string line(name);
    for (const auto& [value, indicator] : values)
        line += value == 0 ? std::string(16, ' ') : fmt::format("{:14.3f}{} ", value, indicator);
    return line + '\n';
}

std::string epoch(double second, int flag, int count) {
    return fmt::format("> 2019 04 28 12 44{:11.7f}  {}{:3}\n", second, flag, count);
}

struct Read {
    std::vector<GnssRaw> raws;
    std::vector<Timestamp> times;
    std::vector<std::string> problems; ///< "7: why"
    Observations::Counts counts;
    std::size_t out_of_range = 0;
};

Read read(const std::string& text, const std::map<std::uint8_t, std::uint8_t>& slots = {}) {
    struct Sink : MeasurementSink {
        Read read;
        void accept(Timestamp time, const Observation& observation) override {
            read.raws.push_back(std::get<GnssRaw>(observation));
            read.times.push_back(time);
        }
        void refuse(Refusal reason) override { read.out_of_range += reason == Refusal::out_of_range; }
    } sink;
    Observations observations{address(7)};
    observations.set_glonass_slots(slots);
    std::istringstream stream(text);
    std::string line, error;
    int number = 0;
    const auto note = [&] {
        if (!error.empty()) sink.read.problems.push_back(std::to_string(number) + ": " + error);
        error.clear();
    };
    while (std::getline(stream, line)) {
        ++number;
        observations.read(line, sink, error);
        note();
    }
    observations.finish(error);
    note();
    sink.read.counts = observations.counts();
    return sink.read;
}

const std::string head = version("3.04", 'O', 'M') + headed("G    4 C1C L1C D1C S1C", "SYS / # / OBS TYPES") +
                         headed("E    3 C1X L1X C5Q", "SYS / # / OBS TYPES") +
                         headed("C    1 C2I", "SYS / # / OBS TYPES") + headed("R    2 C1C L1C", "SYS / # / OBS TYPES") +
                         headed("I    1 C5A", "SYS / # / OBS TYPES") +
                         headed("  2 R01  1 R24 -7", "GLONASS SLOT / FRQ #") + headed("", "END OF HEADER");

TEST(RinexObservations, OfOneEpoch) {
    const auto file =
        read(head + epoch(33.997, 0, 6) +
             satellite_line("G05", {{21600712.022, ' '}, {113512506.876, '0'}, {445.146, ' '}, {27, ' '}}) +
             satellite_line("E36", {{24e6, ' '}, {0, ' '}, {24e6 + 1, ' '}}) + satellite_line("C 3", {{37e6, ' '}}) +
             satellite_line("C11", {{22e6, ' '}}) + satellite_line("R24", {{20e6, ' '}, {1e8, ' '}}) +
             satellite_line("I02", {{3e7, ' '}}));
    EXPECT_THAT(file.problems, IsEmpty());
    ASSERT_EQ(file.raws.size(), 6u);
    const GnssRaw& gps = file.raws[0];
    EXPECT_EQ(file.times[0], timestamp(GpsTime{2051, 45873.997}));
    EXPECT_EQ(gps.tag, address(7));
    EXPECT_EQ(gps.gps_week, 2051);
    EXPECT_DOUBLE_EQ(gps.receiver_time_s_in_gps_week, 45873.997);
    EXPECT_EQ(gps.pseudorange_m, 21600712.022);
    EXPECT_EQ(gps.carrier_cycles, 113512506.876);
    EXPECT_EQ(gps.doppler_hz, 445.146);
    EXPECT_EQ(gps.carrier_to_noise_dbhz, 27);
    EXPECT_TRUE(std::isnan(gps.sigma_pseudorange_m));
    const auto who = [&](std::size_t i) {
        const GnssRaw& raw = file.raws[i];
        return std::array<int, 4>{raw.constellation, raw.satellite, raw.signal, raw.glonass_slot};
    };
    EXPECT_THAT(who(0), ElementsAre(constellation::gps, 5, 0, 0));
    EXPECT_THAT(who(1), ElementsAre(constellation::galileo, 36, 0, 0));
    EXPECT_THAT(who(2), ElementsAre(constellation::galileo, 36, 4, 0)) << "E5a";
    EXPECT_THAT(who(3), ElementsAre(constellation::beidou, 3, 1, 0)) << "geostationary: D2";
    EXPECT_THAT(who(4), ElementsAre(constellation::beidou, 11, 0, 0));
    EXPECT_THAT(who(5), ElementsAre(constellation::glonass, 24, 0, 0)) << "channel -7";
    EXPECT_EQ(file.counts.other_satellites, 1u);
    EXPECT_EQ(file.counts.epochs, 1u);
}

TEST(RinexObservations, LockGoesOnUntilTheFileSaysOtherwise) {
    const auto sample = [](double second, char indicator, double carrier = 1e8, int flag = 0) {
        return epoch(second, flag, 1) + satellite_line("G05", {{2e7, ' '}, {carrier, indicator}});
    };
    const auto file =
        read(head + sample(10, ' ') + sample(11, '0') + sample(12, '2') + sample(13, '1') + sample(14, ' ') +
             sample(15, ' ', 0) + sample(16, ' ') + sample(17, ' ') + sample(18, ' ', 1e8, 1) + sample(19, ' ') +
             sample(20, '2') + sample(21, '2') + sample(22, ' ') + sample(23, ' '));
    std::vector<float> locks_s;
    for (const auto& raw : file.raws) locks_s.push_back(raw.lock_s);
    EXPECT_THAT(locks_s, ElementsAre(0, 1, 0, 0, 1, 0, 0, 1, 0, 1, 0, 1, 0, 1))
        << "half a cycle in doubt at 12, 20 and 21 and settled at 22, slip at 13, no carrier at 15, power failed "
           "before 18";
}

TEST(RinexObservations, EventsAreNoEpochs) {
    const std::string sample = satellite_line("G05", {{2e7, ' '}});
    const auto file =
        read(head + epoch(1, 0, 1) + sample + ">                              4  1\n" +
             headed("G    2 L1C C1C", "SYS / # / OBS TYPES") + epoch(2, 0, 1) +
             satellite_line("G05", {{1e8, ' '}, {2.1e7, ' '}}) + ">                              5  0\n" +
             ">                              3  2\n" + headed("HERE", "MARKER NAME") + headed("1", "MARKER NUMBER") +
             epoch(3, 6, 2) + sample + sample + epoch(4, 0, 1) + satellite_line("G05", {{1e8, ' '}, {2.2e7, ' '}}));
    EXPECT_THAT(file.problems, IsEmpty());
    std::vector<double> ranges_m;
    for (const auto& raw : file.raws) ranges_m.push_back(raw.pseudorange_m);
    EXPECT_THAT(ranges_m, ElementsAre(2e7, 2.1e7, 2.2e7)) << "also with the types that the event brought";
    EXPECT_EQ(file.counts.epochs, 3u);
}

TEST(RinexObservations, LinesOfWindowsAndLinesThatAreCut) {
    std::string text = head + epoch(1, 0, 3) + satellite_line("G05", {{2e7, ' '}, {1e8, ' '}}) + "G06  21600712.022\n" +
                       "G07  2160071\n" + epoch(2, 0, 1) + satellite_line("G05", {{2e7, ' '}});
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2) text.insert(at, "\r");
    const auto file = read(text);
    EXPECT_EQ(file.raws.size(), 3u);
    ASSERT_EQ(file.problems.size(), 1u);
    EXPECT_THAT(file.problems[0], HasSubstr("12: '2160071' in column 4"));
}

TEST(RinexObservations, WhatIsWrongIsToldWithItsLineAndCostsNoMore) {
    const std::string good = satellite_line("G05", {{2e7, ' '}});
    const auto file = read(head + "rubbish\n" + epoch(1, 0, 2) + good + epoch(2, 0, 1) + good +
                           "> 2019 13 28 12 44  3.0000000  0  1\n" + good + "> 2019 04 28 12 44  4.0000000  9  1\n" +
                           epoch(5, 0, 3) + satellite_line("G33", {{2e7, ' '}}) + satellite_line("?05", {{2e7, ' '}}) +
                           "G05    twenty.000  \n" + epoch(6, 0, 2) + good);
    EXPECT_EQ(file.raws.size(), 3u);
    EXPECT_THAT(file.problems,
                ElementsAre(HasSubstr("9: there should stand the time of an epoch"),
                            HasSubstr("12: the epoch before it has 1 satellites less"),
                            HasSubstr("14: the time of the epoch cannot be read"),
                            HasSubstr("16: the flag and the number"), HasSubstr("18: there is no satellite 'G33'"),
                            HasSubstr("19: it begins with no satellite"), HasSubstr("20: 'twenty.000' in column 4"),
                            HasSubstr("22: the last epoch has 1 satellites less")));
}

TEST(RinexObservations, SurprisesInTheHeader) {
    EXPECT_THAT(read(head.substr(0, 300)).problems, ElementsAre(HasSubstr("the file ends inside its header")));
    EXPECT_THAT(read(version("3.04", 'O', 'M') + headed("G    1   100  1 C1C", "SYS / SCALE FACTOR") +
                     headed("", "END OF HEADER"))
                    .problems,
                ElementsAre(HasSubstr("2: values that are multiplied")));
    EXPECT_THAT(
        read(version("3.04", 'O', 'M') + headed("  1 R01 99", "GLONASS SLOT / FRQ #") + headed("", "END OF HEADER"))
            .problems,
        ElementsAre(HasSubstr("2: the table of GLONASS frequencies")));
    const auto unknown = read(version("3.04", 'O', 'M') + headed("", "END OF HEADER") + epoch(1, 0, 1) +
                              satellite_line("G05", {{2e7, ' '}}));
    EXPECT_THAT(unknown.problems, ElementsAre(HasSubstr("the header does not say what is measured of 'G'")));
}

TEST(RinexObservations, MoreTypesThanALineHolds) {
    std::string text = version("3.04", 'O', 'M') +
                       headed("G   14 C1C L1C D1C S1C C2W L2W D2W S2W C2L L2L D2L S2L C5Q", "SYS / # / OBS TYPES") +
                       headed("       L5Q", "SYS / # / OBS TYPES") + headed("", "END OF HEADER") + epoch(1, 0, 1);
    std::vector<std::pair<double, char>> values(14, {2e7, ' '});
    const auto file = read(text + satellite_line("G05", values));
    std::vector<int> signals;
    for (const auto& raw : file.raws) signals.push_back(raw.signal);
    EXPECT_THAT(signals, ElementsAre(0, 3, 7));
    EXPECT_EQ(file.raws[2].carrier_cycles, 2e7) << "from the line that goes on";
    EXPECT_EQ(file.counts.without_number, 1u) << "L2 P(Y)";
}

TEST(RinexObservations, GlonassNeedsAChannel) {
    const std::string text =
        head + epoch(1, 0, 2) + satellite_line("R05", {{2e7, ' '}}) + satellite_line("R01", {{2e7, ' '}});
    const auto without = read(text), with = read(text, {{5, 9}, {1, 0}});
    EXPECT_EQ(without.counts.without_frequency, 1u);
    ASSERT_EQ(with.raws.size(), 2u);
    EXPECT_EQ(with.raws[0].glonass_slot, 9);
    EXPECT_EQ(with.raws[1].glonass_slot, 8) << "the header's own comes first";
}

TEST(RinexObservations, OtherTimeSystems) {
    const auto with = [](std::string_view system) {
        return read(version("3.04", 'O', 'M') + headed("G    1 C1C", "SYS / # / OBS TYPES") +
                    headed(fmt::format("{:48}{}", "", system), "TIME OF FIRST OBS") + headed("", "END OF HEADER") +
                    epoch(0, 0, 1) + satellite_line("G05", {{2e7, ' '}}));
    };
    const double gps_s = with("GPS").raws.at(0).receiver_time_s_in_gps_week;
    EXPECT_EQ(with("GLO").raws.at(0).receiver_time_s_in_gps_week - gps_s, 18);
    EXPECT_EQ(with("BDT").raws.at(0).receiver_time_s_in_gps_week - gps_s, 14);
    EXPECT_THAT(with("XYZ").problems, ElementsAre(HasSubstr("the time system 'XYZ' is not known")));
}

TEST(RinexObservations, RangesThatCannotBeAreRefused) {
    const auto file = read(head + epoch(1, 0, 3) + satellite_line("G05", {{-2e7, ' '}}) +
                           satellite_line("G06", {{2e8, ' '}}) + satellite_line("G07", {{0, ' '}, {1e8, ' '}}));
    EXPECT_TRUE(file.raws.empty());
    EXPECT_EQ(file.out_of_range, 2u);
    EXPECT_EQ(file.counts.without_range, 1u);
}

struct NavigationRead {
    std::vector<NavigationRecord> records;
    std::vector<std::string> problems;
    std::uint64_t passed_over = 0;
    std::optional<Klobuchar> ionosphere;
};

NavigationRead read_navigation(const std::string& text) {
    NavigationRead read;
    Navigation navigation;
    std::istringstream stream(text);
    std::string error;
    const auto keep = [&](const std::optional<NavigationRecord>& record) {
        if (record) read.records.push_back(*record);
        if (!error.empty()) read.problems.push_back(error);
        error.clear();
    };
    for (std::string line; std::getline(stream, line);) keep(navigation.read(line, error));
    keep(navigation.finish(error));
    read.passed_over = navigation.passed_over();
    read.ionosphere = navigation.ionosphere();
    return read;
}

/// The numbers of a record behind its first line's satellite and date.
std::string record(std::string first, const std::vector<double>& values, std::size_t indent = 4) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i >= 3 && (i - 3) % 4 == 0) first += '\n' + std::string(indent, ' ');
        std::string number = fmt::format("{:19.12E}", values[i]);
        number[number.find('E')] = 'D';
        first += number;
    }
    return first + '\n';
}

std::vector<double> gps_values() {
    return {-1e-4,   1e-11,  0,       61,   -37.75,  4.9e-9, 0.4,   -1.9e-6, 0.0189,  4.8e-6,
            5153.69, 590400, -2.9e-7, -2.4, -9.3e-9, 0.95,   287.8, -1.7,    -8.7e-9, -1.8e-10,
            1,       2050,   0,       2,    0,       -2e-8,  61,    583140,  4};
}

const std::string navigation_head = version("3.04", 'N', 'M') + headed("", "END OF HEADER");

TEST(RinexNavigation, Gps) {
    const auto file = read_navigation(navigation_head + record("G02 2019 04 27 20 00 00", gps_values()));
    EXPECT_THAT(file.problems, IsEmpty());
    ASSERT_EQ(file.records.size(), 1u);
    const auto& e = std::get<KeplerEphemeris>(file.records[0].ephemeris);
    EXPECT_EQ(e.satellite, 2);
    EXPECT_EQ(e.week, 2050);
    EXPECT_EQ(e.toe_s, 590400);
    EXPECT_EQ(e.toc_s, 590400);
    EXPECT_EQ(e.issue, 61);
    EXPECT_EQ(e.accuracy, 0);
    EXPECT_EQ(e.root_a, 5153.69);
    EXPECT_EQ(file.records[0].sent, (GpsTime{2050, 583140}));
    EXPECT_EQ(file.records[0].leap_s, 18);
}

TEST(RinexNavigation, IonosphereOfTheHeader) {
    const Klobuchar expected{{0.1118e-7, 0.2235e-7, -0.5960e-7, -0.1192e-6}, {0.1044e6, 0.9830e5, -0.1966e6, -393200}};
    const std::string version3 = version("3.04", 'N', 'M') +
                                 headed("BDSA   9.3132D-09  8.9407D-08 -1.0133D-06  2.0862D-06", "IONOSPHERIC CORR") +
                                 headed("GPSA   1.1180D-08  2.2350D-08 -5.9600D-08 -1.1920D-07", "IONOSPHERIC CORR") +
                                 headed("GPSB   1.0440D+05  9.8300D+04 -1.9660D+05 -3.9320D+05", "IONOSPHERIC CORR");
    const std::string version2 = version("2.11", 'N', ' ') +
                                 headed("    .1118D-07   .2235D-07  -.5960D-07  -.1192D-06", "ION ALPHA") +
                                 headed("    .1044D+06   .9830D+05  -.1966D+06  -.3932D+06", "ION BETA");
    EXPECT_EQ(read_navigation(version3 + headed("", "END OF HEADER")).ionosphere, expected);
    EXPECT_EQ(read_navigation(version2 + headed("", "END OF HEADER")).ionosphere, expected);
    EXPECT_FALSE(read_navigation(navigation_head).ionosphere);
    const auto odd = read_navigation(version("2.11", 'N', ' ') + headed("    .1118D-07   x", "ION ALPHA"));
    EXPECT_EQ(odd.problems[0], "coefficient 2 of the ionosphere is no number");
}

TEST(RinexNavigation, Version2SaysNoLetterAndTwoDigitsOfTheYear) {
    auto values = gps_values();
    values[27] = 0.9999e9;
    const auto gps = read_navigation(version("2.11", 'N', ' ') + headed("", "END OF HEADER") +
                                     record(" 2 19  4 27 20  0  0.0", values, 3));
    ASSERT_EQ(gps.records.size(), 1u);
    EXPECT_EQ(std::get<KeplerEphemeris>(gps.records[0].ephemeris).constellation, constellation::gps);
    EXPECT_EQ(gps.records[0].sent, (GpsTime{2050, 583200})) << "not told: two hours before";
    const auto glonass = read_navigation(
        version("2.11", 'G', ' ') + headed("", "END OF HEADER") +
        record(" 9 19  4 27 23 45  0.0", {1e-5, 2e-12, 84600, 11e3, 1, 0, 0, -12e3, 2, 0, -3, 19e3, 3, 0, 1}, 3));
    EXPECT_THAT(glonass.problems, IsEmpty());
    ASSERT_EQ(glonass.records.size(), 1u);
    const auto& e = std::get<GlonassEphemeris>(glonass.records[0].ephemeris);
    EXPECT_EQ(e.satellite, 9);
    EXPECT_EQ(e.frequency, -3);
    EXPECT_EQ(e.position_m, (Vec3{11e6, -12e6, 19e6}));
    EXPECT_EQ(e.reference, (GpsTime{2050, 6 * 86400 + 23.75 * 3600 + 18}));
    EXPECT_EQ(glonass.records[0].sent, (GpsTime{2050, 6 * 86400 + 23.5 * 3600 + 18}));
    EXPECT_EQ(e.frame_s_in_day, 2.5 * 3600) << "Moscow";
}

TEST(RinexNavigation, BeidouAndGalileoCountTheirOwnWeeks) {
    auto beidou = gps_values();
    beidou[21] = 694, beidou[27] = 590400, beidou[28] = 3;
    auto galileo = gps_values();
    galileo[20] = 517, galileo[23] = 3.12, galileo[24] = 0b1'1000'0011, galileo[26] = 1e-9;
    auto fnav = galileo;
    fnav[20] = 258;
    const auto file = read_navigation(
        navigation_head + record("C11 2019 04 27 20 00 00", beidou) + record("E05 2019 04 27 20 00 00", galileo) +
        record("E05 2019 04 27 20 00 00", fnav) + record("S33 2019 04 27 20 00 00", {1, 2, 3, 4, 5, 6}));
    EXPECT_THAT(file.problems, IsEmpty());
    ASSERT_EQ(file.records.size(), 2u);
    EXPECT_EQ(file.passed_over, 2u);
    const auto& c = std::get<KeplerEphemeris>(file.records[0].ephemeris);
    EXPECT_EQ(c.week, 694);
    EXPECT_EQ(c.issue_clock, 3);
    EXPECT_EQ(file.records[0].sent, (GpsTime{2050, 590414}));
    const auto& e = std::get<KeplerEphemeris>(file.records[1].ephemeris);
    EXPECT_EQ(e.week, 2050 - 1024);
    EXPECT_EQ(e.accuracy, 107) << "2 m + 7 * 0.16 m";
    EXPECT_EQ(e.health, 0b11'01'0'1) << "E5b 3, E1B 1, E1B data 1";
}

TEST(RinexNavigation, ATransmissionTimeBeforeTheWeekBegan) {
    auto values = gps_values();
    values[11] = 0, values[21] = 2051, values[27] = -7260;
    const auto file = read_navigation(navigation_head + record("G03 2019 04 28 00 00 00", values));
    ASSERT_EQ(file.records.size(), 1u);
    EXPECT_EQ(file.records[0].sent, (GpsTime{2050, 597540}));
}

TEST(RinexNavigation, WhatIsWrongIsToldAndTheNextIsRead) {
    auto cut = gps_values();
    cut.resize(20);
    auto halves = gps_values();
    halves[3] = 61.5;
    const std::string good = record("G02 2019 04 27 20 00 00", gps_values());
    std::string letters = good;
    letters.replace(letters.find("D-11"), 4, "XXXX");
    const auto file = read_navigation(
        navigation_head + record("G03 2019 04 27 20 00 00", cut) + record("G04 2019 04 31 20 00 00", gps_values()) +
        record("G05 2019 04 27 20 00 00", halves) + record("G77 2019 04 27 20 00 00", gps_values()) + letters + good);
    EXPECT_EQ(file.records.size(), 1u);
    EXPECT_THAT(file.problems,
                ElementsAre(HasSubstr("G03: number 26 of the record is missing"), HasSubstr("G04: its time is no date"),
                            HasSubstr("G05: number 4 of the record has no whole value"), HasSubstr("'"),
                            HasSubstr("G02: number 2 of the record is missing")));
    EXPECT_THAT(read_navigation(version("3.04", 'N', 'M')).problems,
                ElementsAre(HasSubstr("the file ends inside its header")));
    EXPECT_THAT(read_navigation("hello\n").problems[0], HasSubstr("not the first line of a RINEX file"));
}

TEST(RinexText, NumbersAsFortranWritesThem) {
    EXPECT_EQ(real("-.344484578818D-03"), -.344484578818e-3);
    EXPECT_EQ(real("1.5d+02"), 150);
    EXPECT_EQ(real("+2.5"), 2.5);
    for (const char* wrong : {"", "D", "1.5D", "nan", "inf", "1e999", "1 2", "0x10"})
        EXPECT_FALSE(real(wrong)) << wrong;
    EXPECT_EQ(date("19  4 28 12 44 33.5"), (CivilTime{2019, 4, 28, 12, 44, 33.5}));
    EXPECT_EQ(date("99 4 28 12 44 33"), (CivilTime{1999, 4, 28, 12, 44, 33}));
    for (const char* wrong : {"", "2019 4 28", "2019 4 28 12 44", "2019 4 28 12 44 x"})
        EXPECT_FALSE(date(wrong)) << wrong;
    EXPECT_FALSE(satellite("G00") || satellite("G33") || satellite("S05") || satellite("X01") || satellite("G"));
    EXPECT_EQ(satellite("S33")->number, 133);
}

} // namespace
} // namespace locus::gnss::rinex
