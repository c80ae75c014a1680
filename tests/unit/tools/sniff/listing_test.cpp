// Frame by frame: what was understood, what was skipped and why, as text and as JSON.
#include "tools/sniff/listing.h"

#include "tests/examples/decoder_example.h"
#include "tools/sniff/baud.h"
#include "tools/sniff/census.h"
#include "tools/sniff/entry_lines.h"
#include "tools/sniff/words.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <random>

namespace locus::sniff {
namespace {

using examples::Chunk;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;

Packet packet_of(std::span<const std::uint8_t> bytes, double time_s = 0) {
    Packet packet;
    packet.time = Timestamp{} + duration_from_s(time_s);
    packet.data = bytes;
    return packet;
}

const examples::DecoderExample& example_of(std::string_view decoder) {
    return *std::ranges::find(examples::all(), decoder, &examples::DecoderExample::decoder);
}

std::vector<Entry> listed(std::string_view decoder, std::span<const std::uint8_t> bytes, std::uint64_t most = 0) {
    std::vector<Entry> entries;
    const DecoderRow& row = *find_decoder(decoder);
    Listing listing{row, row.options.make().get(), most, [&](const Entry& entry) { entries.push_back(entry); }};
    listing.packet(packet_of(bytes));
    listing.finish();
    return entries;
}

TEST(Listing, FramesHaveTheirOwnBytesAndSkippedOnesAreCounted) {
    const Chunk frame = example_of("witmotion").chunks[0]; // two frames of eleven bytes
    Chunk bytes{1, 2, 3};
    bytes.insert(bytes.end(), frame.begin(), frame.end());
    bytes.insert(bytes.end(), 5, 0x55);
    bytes.insert(bytes.end(), frame.begin(), frame.end());
    const auto entries = listed("witmotion", bytes);
    ASSERT_EQ(entries.size(), 6u);
    EXPECT_THAT(entries[0].refusals, ElementsAre(Refusal::garbage));
    EXPECT_EQ(entries[0].skipped, 3u);
    EXPECT_EQ(entries[1].bytes, Chunk(frame.begin(), frame.begin() + 11));
    EXPECT_TRUE(entries[1].measurements.empty());
    EXPECT_EQ(entries[2].bytes, Chunk(frame.begin() + 11, frame.end()));
    ASSERT_EQ(entries[2].measurements.size(), 1u);
    EXPECT_EQ(entries[3].skipped, 5u);
    EXPECT_THAT(entry_text(entries[0], 1.5), HasSubstr("1.500000  refused: garbage 1; 3 bytes skipped"));
    EXPECT_THAT(entry_text(entries[2], 0), HasSubstr("55 52"));
    EXPECT_THAT(entry_text(entries[2], 0), HasSubstr("  IMU "));
    EXPECT_EQ(json::parse(entry_json(entries[2], 0))["measurements"][0]["class"], "IMU");
    EXPECT_EQ(json::parse(entry_json(entries[0], 0))["skipped_bytes"], 3);
}

TEST(Listing, TheEndOfALineIsNotSkipped) {
    Chunk bytes = example_of("trek1000").chunks[0];
    const Chunk nonsense = examples::chunk("what is this\r\n"), good = example_of("trek1000").chunks[1];
    bytes.insert(bytes.end(), nonsense.begin(), nonsense.end());
    bytes.insert(bytes.end(), good.begin(), good.end());
    const auto entries = listed("trek1000", bytes);
    ASSERT_EQ(entries.size(), 3u);
    EXPECT_NEAR(static_cast<double>(entries[1].skipped), static_cast<double>(nonsense.size()), 2);
}

TEST(Listing, StopsAfterSoManyFrames) {
    const Chunk frame = example_of("witmotion").chunks[0];
    EXPECT_EQ(listed("witmotion", frame, 1).size(), 1u);
}

TEST(Listing, OfCanSaysWhoseFrameItIs) {
    std::vector<Entry> entries;
    const DecoderRow& row = *find_decoder("dw1000_can");
    Listing listing{row, row.options.make().get(), 0, [&](const Entry& entry) { entries.push_back(entry); }};
    listing.packet(example_of("dw1000_can").frames[0].packet({}));
    listing.packet(example_of("dw1000_can").rubbish[0].packet({}));
    listing.packet(CanFrame{0x123, 8, {}}.packet({})); // of somebody else
    listing.finish();
    ASSERT_EQ(entries.size(), 2u);
    EXPECT_THAT(entry_text(entries[0], 0), HasSubstr("340#"));
    EXPECT_THAT(entry_text(entries[0], 0), HasSubstr("RANGE anchor 0 tag 0 range_m 2.5"));
    EXPECT_THAT(entry_text(entries[1], 0), HasSubstr("342#00 00 00 00 00 00 00 00  refused: unknown_type 1"));
    EXPECT_EQ(json::parse(entry_json(entries[1], 0))["id"], "342");
    EXPECT_THAT(summary_lines(listing)[0], HasSubstr("24 bytes (0 a second), 1 frames"));
    EXPECT_EQ(json::parse(summary_json(listing))["measurements"]["RANGE"], 1);
}

TEST(Words, BytesAreShortened) {
    EXPECT_EQ(short_hex(Chunk{0x55, 5}), "55 05");
    EXPECT_EQ(short_hex(Chunk{1, 2, 3, 4, 5}, 4), "01 02 .. 05");
    EXPECT_EQ(short_hex({}), "");
}

TEST(Words, ColumnsSayWhatChanges) {
    std::vector<Chunk> frames;
    for (std::uint8_t i = 0; i < 20; ++i) frames.push_back({0x55, 0x05, i, static_cast<std::uint8_t>(i * 37), 7});
    EXPECT_EQ(columns_text(frames), "0-1 always 55 05, 2 counts up, 4 always 07, the rest changes");
    EXPECT_EQ(columns_text({}), "");
}

TEST(Census, SaysWhoIsOnTheBus) {
    Capture capture;
    for (int i = 0; i < 100; ++i) {
        CanFrame frame{0x123, static_cast<std::uint8_t>(i % 2 ? 8 : 2), {static_cast<std::uint8_t>(i)}};
        capture.packet(frame.packet(Timestamp{} + std::chrono::milliseconds{10 * i}));
    }
    capture.packet(CanFrame{0x98EF0180, 8, {}}.packet({}));
    const auto ids = census(capture);
    ASSERT_EQ(ids.size(), 2u);
    EXPECT_EQ(id_text(ids[0].can_id), "123");
    EXPECT_NEAR(ids[0].rate_hz, 100, 1e-6);
    EXPECT_EQ(ids[0].shortest, 2u);
    EXPECT_EQ(ids[0].longest, 8u);
    EXPECT_EQ(id_text(ids[1].can_id), "18EF0180");
    EXPECT_THAT(looks_like(ids), ElementsAre(HasSubstr("PulsON")));
}

TEST(Census, IsBounded) {
    Capture capture;
    for (std::uint32_t i = 0; i < 5000; ++i) capture.packet(CanFrame{0x80000000u | i, 1, {}}.packet({}));
    EXPECT_EQ(census(capture).size(), 512u);
}

/// A line that talks at one rate, and at all others gives noise.
class Line {
  public:
    Line(int baud_bd, Chunk bytes) : baud_bd_{baud_bd}, bytes_{std::move(bytes)} {}
    std::optional<Capture> operator()(int baud_bd) {
        tried.push_back(baud_bd);
        std::mt19937 random{static_cast<unsigned>(baud_bd)};
        Chunk noise(2000);
        for (std::uint8_t& byte : noise) byte = static_cast<std::uint8_t>(random());
        Capture capture;
        capture.packet(packet_of(baud_bd == baud_bd_ ? bytes_ : noise));
        return capture;
    }
    std::vector<int> tried;

  private:
    int baud_bd_;
    Chunk bytes_;
};

Chunk joined(const std::vector<Chunk>& chunks) {
    Chunk all;
    for (const Chunk& chunk : chunks) all.insert(all.end(), chunk.begin(), chunk.end());
    return all;
}

TEST(BaudRate, IsTheOneAtWhichADecoderUnderstands) {
    Line line{460800, joined(example_of("nlink").chunks)};
    const auto found = find_baud_rate(std::ref(line));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->baud_bd, 460800);
    EXPECT_EQ(found->winners.at(0).decoder->name, "nlink");
    EXPECT_THAT(line.tried, ElementsAre(115200, 9600, 921600, 460800)) << "no need to go on";
}

TEST(BaudRate, OfAnUnknownDeviceIsWhereThereAreLines) {
    std::string text;
    for (int i = 0; i < 50; ++i) text += "temperature " + std::to_string(20 + i) + "\r\n";
    Line line{57600, examples::chunk(text)};
    const auto found = find_baud_rate(std::ref(line));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->baud_bd, 57600);
    EXPECT_TRUE(found->winners.empty());
    EXPECT_EQ(line.tried.size(), usual_baud_rates.size());
}

TEST(BaudRate, OfNoiseOrSilenceIsNone) {
    Line noise{1, {}};
    EXPECT_FALSE(find_baud_rate(std::ref(noise)));
    EXPECT_FALSE(find_baud_rate([](int) { return Capture{}; }));
    EXPECT_FALSE(find_baud_rate([](int) { return std::optional<Capture>{}; })) << "the port is gone";
}

} // namespace
} // namespace locus::sniff
