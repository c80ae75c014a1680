// FrameStream with a format of its own: A5, length of the payload, payload, sum.
#include "drivers/wire/frame_stream.h"

#include "drivers/wire/checksum.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>

namespace locus {
namespace {

using namespace std::chrono_literals;

struct Toy {
    static constexpr std::size_t max_length = 64;
    Look look(wire::Bytes bytes) const {
        if (bytes[0] != 0xA5) return Look::none(Refusal::garbage);
        if (bytes.size() < 2) return Look::need(2);
        const std::size_t length = bytes[1] + 3u;
        if (length > max_length) return Look::none(Refusal::too_long);
        if (bytes.size() < length) return Look::need(length);
        if (wire::sum8(bytes.first(length - 1)) != bytes[length - 1]) return Look::none(Refusal::bad_checksum);
        return Look::frame(length);
    }
};

struct Stream {
    FrameStream<Toy> frames;
    std::vector<std::string> payloads;
    std::vector<Refusal> refusals;
    Timestamp begun, complete;

    void feed(std::string_view bytes, Timestamp time = {}, Duration byte_time = {}) {
        frames.feed(
            test::bytes_packet(bytes, time, byte_time),
            [&](const Frame& frame) {
                payloads.emplace_back(frame.bytes.begin() + 2, frame.bytes.end() - 1);
                begun = frame.begun, complete = frame.complete;
            },
            [&](Refusal reason) { refusals.push_back(reason); });
    }
};

std::string toy(std::string_view payload) {
    std::string frame = "\xA5";
    frame += static_cast<char>(payload.size());
    frame += payload;
    return frame += static_cast<char>(wire::sum8({reinterpret_cast<const std::uint8_t*>(frame.data()), frame.size()}));
}

TEST(FrameStream, DatesAFrameByItsPlaceInTheChunk) {
    Stream stream;
    stream.feed(toy("abc") + "xxxx", Timestamp{1ms}, 10us);
    EXPECT_EQ(stream.complete, Timestamp{1ms - 40us});
    EXPECT_EQ(stream.begun, Timestamp{1ms - 40us - 60us});
}

TEST(FrameStream, AFalseHeadHidesNoFrame) {
    Stream stream;
    stream.feed(std::string{"\xA5\x30"} + toy("one") + toy("two"));
    EXPECT_TRUE(stream.payloads.empty()) << "the false head claims 51 bytes";
    stream.feed(toy(std::string(40, 'x')));
    EXPECT_EQ(stream.payloads, (std::vector<std::string>{"one", "two", std::string(40, 'x')}));
    EXPECT_EQ(stream.refusals, (std::vector{Refusal::bad_checksum, Refusal::garbage}));
}

TEST(FrameStream, AHeadWithoutItsRestIsGivenUpAfterASilence) {
    Stream stream;
    stream.feed(std::string{"\xA5\x30"} + toy("one"), Timestamp{0s});
    stream.feed(toy("two"), Timestamp{3s});
    EXPECT_EQ(stream.payloads, (std::vector<std::string>{"one", "two"}));
}

TEST(FrameStream, ARunOfGarbageIsToldOnce) {
    Stream stream;
    stream.feed("xyz");
    stream.feed("xyz" + toy("a") + "q" + toy("b"));
    EXPECT_EQ(stream.refusals, (std::vector{Refusal::garbage, Refusal::garbage}));
}

TEST(FrameStream, AnyAmountAtOnce) {
    Stream stream;
    std::string bytes;
    for (int i = 0; i < 1000; ++i) bytes += toy(std::to_string(i));
    stream.feed(bytes);
    EXPECT_EQ(stream.payloads.size(), 1000u);
    EXPECT_TRUE(stream.refusals.empty());
}

TEST(FrameStream, ResetForgetsTheHalf) {
    Stream stream;
    stream.feed(toy("abc").substr(0, 3));
    stream.frames.reset();
    stream.feed(toy("abc"));
    EXPECT_EQ(stream.payloads.size(), 1u);
    EXPECT_TRUE(stream.refusals.empty());
}

} // namespace
} // namespace locus
