#include "drivers/uwb/pdoa_json.h"

#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cstdio>

namespace locus::uwb {
namespace {

using test::Collector;

/// protocols.md E-1, TV.
constexpr std::string_view twr_line =
    R"(JS0076{"TWR": {"a16":"2E5C","R":3,"T":8605,"D":343,"P":1695,"Xcm":165,"Ycm":165,"O":14,"V":1,"X":53015,"Y":60972,"Z":10797}})";
const PdoaReport twr{0x2E5C, 3, 8605, 343, 1695, 165, 165, 14, 1, {53015, 60972, 10797}};

Collector pdoa_decoded(std::string_view text) {
    const PdoaSettings settings{address(5)};
    Collector sink;
    make_pdoa_json(&settings)->decode(test::bytes_packet(text), sink);
    return sink;
}

std::string counted(const std::string& json) {
    char length[8];
    std::snprintf(length, sizeof length, "%4zX", json.size());
    return "JS" + std::string{length} + json + "\r\n";
}

TEST(PdoaJson, ReadsTheExample) {
    PdoaReport report;
    EXPECT_EQ(parse_pdoa_line(twr_line, report), PdoaLine::report);
    EXPECT_EQ(report, twr);
    EXPECT_EQ(encode(twr), std::string{twr_line} + "\r\n");
    const auto ranges = pdoa_decoded(encode(twr)).all<Range>();
    ASSERT_EQ(ranges.size(), 1u);
    EXPECT_EQ(ranges[0].anchor, address(5));
    EXPECT_EQ(ranges[0].tag, address(0x2E5C));
    EXPECT_DOUBLE_EQ(ranges[0].range_m, 3.43);
}

TEST(PdoaJson, OtherObjectsAreFramesWithoutMeasurements) {
    const Collector sink = pdoa_decoded(counted(R"({"NewTag":"10205EA910002B80"})") +
                                        counted(R"({"Info":{"Device":"PDOA Node","List":[1,{"a":[null,true]}]}})"));
    EXPECT_EQ(sink.frames, 2);
    EXPECT_TRUE(sink.items.empty());
    EXPECT_TRUE(sink.refusals.empty());
}

TEST(PdoaJson, TheLengthMayBePadded) {
    EXPECT_EQ(pdoa_decoded(counted(R"({"TWR":{"a16":"0001","D":100}})")).items.size(), 1u);
}

TEST(PdoaJson, RefusesDamage) {
    const std::string good{twr_line};
    for (const std::string& line :
         {good.substr(1), good.substr(0, 50), "JS0075" + good.substr(6), "JS" + good.substr(6), std::string{"JS"},
          std::string{"JS0000"}, std::string{"JS00 0{}"}, good + " ", counted(R"({"TWR":{"a16":"0001"}})"),
          counted(R"({"TWR":{"D":100}})"), counted(R"({"TWR":{"a16":"001","D":100}})"), counted(R"({"TWR":5})"),
          counted(R"({"TWR":{"a16":"0001","D":1e2}})"), counted(R"({"TWR":{"a16":"0001","D":100})")}) {
        const Collector sink = pdoa_decoded(line + "\r\n");
        EXPECT_EQ(sink.refusals, std::vector<Refusal>{Refusal::malformed}) << line;
        EXPECT_TRUE(sink.items.empty()) << line;
    }
}

TEST(PdoaJson, ImpossibleDistancesAreRefused) {
    PdoaReport report = twr;
    for (const int distance_cm : {-1, 100'001}) {
        report.distance_cm = distance_cm;
        EXPECT_EQ(pdoa_decoded(encode(report)).refusals, std::vector<Refusal>{Refusal::out_of_range});
    }
}

TEST(PdoaJson, ReadsBackWhatItWrites) {
    EXPECT_TRUE(
        rc::check([](std::uint16_t tag, std::uint32_t sequence, std::uint32_t time, std::array<std::int32_t, 5> numbers,
                     std::uint32_t flags, std::array<std::uint16_t, 3> acceleration) {
            const PdoaReport said{tag,        sequence,   time,       numbers[0], numbers[1],
                                  numbers[2], numbers[3], numbers[4], flags,      acceleration};
            std::string line = encode(said);
            line.resize(line.size() - 2);
            PdoaReport read;
            RC_ASSERT(parse_pdoa_line(line, read) == PdoaLine::report);
            RC_ASSERT(read == said);
        }));
}

} // namespace
} // namespace locus::uwb
