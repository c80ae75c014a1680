#include "drivers/radio/hm10.h"

#include "tests/examples/decoder_example.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace locus::radio {
namespace {

/// REAL, protocols.md E-7.
const std::string real = "OK+DISC:4C000215:74278BDAB64445208F0C720EAF059935:FFE0FFE1C5:78A5048CECAC:-053";

struct Scanner {
    explicit Scanner(double period_s = 0) {
        const Hm10Settings settings{address(9), period_s};
        decoder = make_hm10(&settings);
    }
    void hear(const std::string& text) { decoder->decode(test::bytes_packet(text), sink); }
    std::unique_ptr<Decoder> decoder;
    test::Collector sink;
};

TEST(Hm10, ReadsAScan) {
    Scanner scanner;
    scanner.hear("OK+DISIS" + real + real + "OK+DISCE");
    const auto strengths = scanner.sink.all<SignalStrength>();
    ASSERT_EQ(strengths.size(), 2u);
    EXPECT_EQ(strengths[0].transmitter, address(0x78A5048CECAC));
    EXPECT_EQ(strengths[0].rssi_dbm, -53);
    EXPECT_EQ(strengths[0].tx_power_dbm, -59);
    EXPECT_EQ(scanner.sink.frames, 4);
    EXPECT_TRUE(scanner.sink.refusals.empty());
}

TEST(Hm10, ReadsEveryFieldOfARecord) {
    const auto record = parse_hm10_record(real);
    ASSERT_TRUE(record);
    EXPECT_EQ(record->uuid, "74278BDAB64445208F0C720EAF059935");
    EXPECT_EQ(record->major, 0xFFE0);
    EXPECT_EQ(record->minor, 0xFFE1);
    EXPECT_EQ(encode(*record), real);
}

TEST(Hm10, ADamagedRecordIsNotBelieved) {
    Scanner scanner;
    std::string damaged = real;
    damaged[76] = 'x';
    scanner.hear(damaged + real);
    EXPECT_EQ(scanner.sink.items.size(), 1u);
    EXPECT_EQ(scanner.sink.refusals.at(0), Refusal::malformed);
}

TEST(Hm10, IsToldToScan) {
    using namespace std::chrono_literals;
    Scanner scanner{5};
    const auto request = scanner.decoder->request(Timestamp{100s});
    ASSERT_TRUE(request);
    EXPECT_TRUE(std::ranges::equal(request->data, std::string_view{"AT+DISI?"}));
    EXPECT_FALSE(scanner.decoder->request(Timestamp{104s}));
    EXPECT_TRUE(scanner.decoder->request(Timestamp{105s}));
    EXPECT_FALSE(Scanner{}.decoder->request(Timestamp{100s})) << "not unless it is set";
}

TEST(Hm10, WhatIsEncodedIsDecoded) {
    rc::check([](std::uint16_t major, std::uint16_t minor, std::int8_t power, std::uint64_t mac) {
        const Hm10Record record{"4C000215",           "74278BDAB64445208F0C720EAF059935", major, minor, power,
                                mac & 0xFFFFFFFFFFFF, -*rc::gen::inRange(0, 1000)};
        RC_ASSERT(parse_hm10_record(encode(record)) == record);
    });
}

} // namespace
} // namespace locus::radio
