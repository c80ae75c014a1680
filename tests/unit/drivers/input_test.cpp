// Input with a transport and a decoder that do what the test says: opening, losing, opening again, counting, telling.
#include "drivers/input.h"

#include <gtest/gtest.h>

#include <atomic>
#include <deque>
#include <thread>

namespace locus {
namespace {

using namespace std::chrono_literals;

/// One step per open() or read(): what it answers, and the bytes it hands over first.
struct Step {
    bool opens = true;
    ReadStatus read = ReadStatus::ok;
    std::vector<std::uint8_t> bytes{};
    std::string error{};
};

class ScriptedTransport : public Transport {
  public:
    ScriptedTransport(std::deque<Step> opens, std::deque<Step> reads)
        : opens_{std::move(opens)}, reads_{std::move(reads)} {}

    bool open() override {
        const Step step = take(opens_, Step{});
        error_ = step.error;
        return step.opens;
    }
    void close() override {}
    ReadStatus read(PacketSink& sink, Duration) override {
        const Step step = take(reads_, Step{.read = ReadStatus::ended});
        if (!step.bytes.empty()) sink.packet({.time = timestamp_from_ns(1'000'000'000), .data = step.bytes});
        error_ = step.error;
        return step.read;
    }
    std::string_view last_error() const override { return error_; }

  private:
    static Step take(std::deque<Step>& steps, Step otherwise) {
        if (steps.empty()) return otherwise;
        Step step = steps.front();
        steps.pop_front();
        return step;
    }

    std::deque<Step> opens_, reads_;
    std::string error_;
};

/// Every byte is a range of so many metres; 255 is refused.
class ByteDecoder : public Decoder {
  public:
    explicit ByteDecoder(int& resets) : resets_{resets} {}
    void decode(const Packet& packet, MeasurementSink& sink) override {
        for (const auto byte : packet.data) {
            if (byte == 255) {
                sink.refuse(Refusal::malformed);
                continue;
            }
            sink.frame({&byte, 1});
            sink.accept(packet.time, Range{.range_m = double(byte)});
        }
    }
    void reset() override { ++resets_; }

  private:
    int& resets_;
};

struct Tap : PacketSink {
    std::vector<std::uint8_t> bytes{};
    void packet(const Packet& packet) override { bytes.insert(bytes.end(), packet.data.begin(), packet.data.end()); }
};

class InputTest : public testing::Test {
  protected:
    Input make(std::deque<Step> opens, std::deque<Step> reads) {
        return Input{{.name = "hall",
                      .index = 7,
                      .transport = std::make_unique<ScriptedTransport>(std::move(opens), std::move(reads)),
                      .decoder = std::make_unique<ByteDecoder>(resets),
                      .delay = 250ms,
                      .ring = &ring,
                      .tap = &tap,
                      .on_event = [this](const InputEvent& event) {
                          events.emplace_back(event.kind, std::string{event.text});
                      }}};
    }

    using Kind = InputEvent::Kind;
    int resets = 0;
    MeasurementRing ring;
    Tap tap;
    std::vector<std::pair<Kind, std::string>> events;
};

TEST_F(InputTest, FillsInputSequenceAndDelay) {
    Input input = make({}, {{.bytes = {3, 255, 4}}});
    input.run({});
    Measurement first{}, second{}, none{};
    ASSERT_TRUE(ring.pop(first) && ring.pop(second));
    EXPECT_FALSE(ring.pop(none));
    EXPECT_EQ(first.input, 7);
    EXPECT_EQ(first.sequence, 0u);
    EXPECT_EQ(second.sequence, 1u);
    EXPECT_EQ(first.time, timestamp_from_ns(750'000'000));
    EXPECT_EQ(std::get<Range>(second.observation).range_m, 4);
    EXPECT_EQ(tap.bytes, (std::vector<std::uint8_t>{3, 255, 4}));
}

TEST_F(InputTest, CountsWhatHappened) {
    Input input = make({}, {{.bytes = {3, 255, 4}}, {.bytes = {5}}});
    input.run({});
    const InputStatus& status = input.status();
    EXPECT_EQ(status.packets, 2u);
    EXPECT_EQ(status.bytes, 4u);
    EXPECT_EQ(status.frames, 3u);
    EXPECT_EQ(status.measurements, 3u);
    EXPECT_EQ(status.refused[std::size_t(Refusal::malformed)], 1u);
    EXPECT_EQ(status.last_packet_ns, 1'000'000'000);
    EXPECT_EQ(status.state, InputState::ended);
}

TEST_F(InputTest, ARunOfDamageIsOneResynchronisation) {
    Input input = make({}, {{.bytes = {255, 255, 1, 2}},
                            {.bytes = {255, 255, 255, 3}},
                            {.read = ReadStatus::lost, .error = "unplugged"},
                            {.bytes = {255, 4, 255}}});
    input.run({});
    EXPECT_EQ(input.status().resyncs, 2u) << "neither the first bytes nor those after an opening can be lost";
}

TEST_F(InputTest, RemembersWhatWentWrongLast) {
    Input input = make({}, {{.read = ReadStatus::lost, .error = "unplugged"}, {.bytes = {2}}});
    EXPECT_EQ(input.status().last_error_ns, 0);
    input.run({});
    EXPECT_EQ(input.status().trouble.get(), "");
    EXPECT_EQ(input.status().last_error.get(), "unplugged");
    EXPECT_GT(input.status().last_error_ns, 0);
}

TEST_F(InputTest, OpensAgainAfterALossAndForgetsHalfFrames) {
    Input input = make({}, {{.bytes = {1}}, {.read = ReadStatus::lost, .error = "unplugged"}, {.bytes = {2}}});
    input.run({});
    EXPECT_EQ(input.status().reconnects, 1u);
    EXPECT_EQ(input.status().measurements, 2u);
    EXPECT_EQ(resets, 2);
    const std::vector<std::pair<Kind, std::string>> expected{
        {Kind::opened, ""}, {Kind::lost, "unplugged"}, {Kind::opened, ""}, {Kind::ended, ""}};
    EXPECT_EQ(events, expected);
    EXPECT_EQ(input.status().trouble.get(), "");
}

TEST_F(InputTest, TellsEachReasonOnceAndNotPerTry) {
    Input input = make({{.opens = false, .error = "no such device"},
                        {.opens = false, .error = "no such device"},
                        {.opens = false, .error = "busy"}},
                       {});
    input.run({});
    const std::vector<std::pair<Kind, std::string>> expected{
        {Kind::unavailable, "no such device"}, {Kind::unavailable, "busy"}, {Kind::opened, ""}, {Kind::ended, ""}};
    EXPECT_EQ(events, expected);
    EXPECT_EQ(input.status().reconnects, 0u);
}

TEST_F(InputTest, AFullRingDropsAndCounts) {
    Input input = make({}, {{.bytes = std::vector<std::uint8_t>(MeasurementRing::capacity() + 3, 1)}});
    input.run({});
    EXPECT_EQ(input.status().ring_dropped, 3u);
    EXPECT_EQ(input.status().measurements, MeasurementRing::capacity() + 3);
}

TEST_F(InputTest, StopsWhileWaitingAndIsReadFromOtherThreads) {
    std::deque<Step> never(1000, Step{.opens = false, .error = "no such device"});
    Input input = make(never, {});
    std::jthread thread{[&](std::stop_token stop) { input.run(stop); }};
    while (input.status().state != InputState::waiting || input.status().trouble.get().empty()) {
        std::this_thread::yield();
    }
    EXPECT_EQ(input.status().trouble.get(), "no such device");
    thread.request_stop();
    thread.join();
    EXPECT_EQ(input.status().state, InputState::stopped);
}

TEST(BackOff, DoublesUpToItsCapAndStartsAnew) {
    BackOff back_off;
    EXPECT_EQ(back_off.next(), 100ms);
    EXPECT_EQ(back_off.next(), 200ms);
    for (int i = 0; i < 10; ++i) EXPECT_LE(back_off.next(), BackOff::cap);
    EXPECT_EQ(back_off.next(), BackOff::cap);
    back_off.reset();
    EXPECT_EQ(back_off.next(), 100ms);
}

TEST(SharedText, IsBounded) {
    SharedText text;
    text.set(std::string(10'000, 'x'));
    EXPECT_EQ(text.get().size(), SharedText::max_size);
}

} // namespace
} // namespace locus
