// Every decoder's own frames are recognised as its own, also among garbage; noise is nobody's.
#include "tools/sniff/contest.h"

#include "tests/examples/decoder_example.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

namespace locus::sniff {
namespace {

using examples::Chunk;
using examples::DecoderExample;
using Names = std::set<std::string_view>;

Names names_of(const std::vector<Standing>& standings) {
    Names names;
    for (const Standing& standing : standings) names.insert(standing.decoder->name);
    return names;
}

class Stream {
  public:
    void add(std::span<const std::uint8_t> bytes) {
        Packet packet;
        packet.time = time_ += std::chrono::milliseconds{200};
        packet.data = bytes;
        capture.packet(packet);
    }
    void add(const CanFrame& frame) { capture.packet(frame.packet(time_ += std::chrono::milliseconds{1})); }

    Capture capture;

  private:
    Timestamp time_{};
};

/// A quarter of what the garbage test of the decoders has, and only between every other frame.
Chunk garbage(std::mt19937& random, bool lines) {
    Chunk bytes(random() % 12);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    if (lines) bytes.push_back('\n');
    return bytes;
}

class Recognition : public testing::TestWithParam<DecoderExample> {
  protected:
    Capture played(bool damaged) const {
        std::mt19937 random{3};
        Stream stream;
        const DecoderExample& example = GetParam();
        if (damaged && !example.datagrams && !example.chunks.empty()) stream.add(garbage(random, example.lines));
        for (std::size_t i = 0; i < example.chunks.size(); ++i) {
            stream.add(example.chunks[i]);
            if (damaged && !example.datagrams && i % 4 == 3) stream.add(garbage(random, example.lines));
        }
        for (std::size_t i = 0; i < example.frames.size(); ++i) {
            stream.add(example.frames[i]);
            if (damaged) stream.add(CanFrame{0x600 + static_cast<std::uint32_t>(random() % 0x100), 8, {}});
        }
        return stream.capture;
    }
};

TEST_P(Recognition, OfItsOwnFrames) {
    for (const bool damaged : {false, true})
        EXPECT_EQ(names_of(winners(contest(played(damaged)))), Names{GetParam().decoder}) << "damaged: " << damaged;
}

std::vector<DecoderExample> without_layouts() {
    std::vector<DecoderExample> some;
    for (const DecoderExample& example : examples::all())
        if (find_decoder(example.decoder)->options.lists.empty()) some.push_back(example);
    return some;
}

INSTANTIATE_TEST_SUITE_P(Decoders, Recognition, testing::ValuesIn(without_layouts()), [](const auto& instance) {
    return std::string{instance.param.decoder} + "_" + std::to_string(instance.index);
});

TEST(Contest, FindsTheSettingThatMustBeAnother) {
    for (const DecoderExample& example : examples::all()) {
        if (example.decoder != "xbee") continue;
        Stream stream;
        for (const Chunk& chunk : example.chunks) stream.add(chunk);
        const auto found = winners(contest(stream.capture));
        ASSERT_EQ(found.size(), 1u);
        EXPECT_EQ(found[0].tally.frames, example.chunks.size());
        EXPECT_EQ(found[0].confidence, Confidence::sure);
    }
}

TEST(Contest, TwoFormatsOnOneLineAreBothNamed) {
    Stream stream;
    std::map<std::string_view, const DecoderExample*> by_name;
    for (const DecoderExample& example : examples::all()) by_name[example.decoder] = &example;
    for (std::size_t i = 0; i < 20; ++i) {
        stream.add(by_name["nmea"]->chunks[i]);
        stream.add(by_name["ubx"]->chunks[i]);
    }
    EXPECT_EQ(names_of(winners(contest(stream.capture))), (Names{"nmea", "ubx"}));
}

TEST(Contest, FramesOfVeryDifferentLengthsAreGuardedAllTheSame) {
    Stream stream;
    for (const DecoderExample& example : examples::all()) {
        if (example.decoder != "ubx") continue;
        for (int i = 0; i < 20; ++i) {
            stream.add(example.chunks[1]); // RAWX of four signals
            for (int k = 0; k < 10; ++k) stream.add(examples::from_hex("B5 62 01 22 00 00 23 6A")); // empty
        }
    }
    const auto found = winners(contest(stream.capture));
    ASSERT_EQ(names_of(found), Names{"ubx"});
    EXPECT_EQ(found[0].confidence, Confidence::sure);
}

TEST(Contest, NoiseIsNobodys) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        std::mt19937 random{seed};
        Stream stream;
        for (int i = 0; i < 64; ++i) {
            Chunk bytes(1 + random() % 128);
            const unsigned kind = seed % 3; // anything, printable, few different ones
            for (std::uint8_t& b : bytes)
                b = static_cast<std::uint8_t>(kind == 0   ? random()
                                              : kind == 1 ? ' ' + random() % 95
                                                          : random() % 4 * 85);
            if (kind == 1) bytes.back() = '\n';
            stream.add(bytes);
        }
        EXPECT_TRUE(winners(contest(stream.capture)).empty()) << "seed " << seed;
    }
}

TEST(Contest, ABusOfStrangersIsNobodys) {
    for (unsigned seed = 0; seed < 100; ++seed) {
        std::mt19937 random{seed};
        Stream stream;
        for (int i = 0; i < 2000; ++i) {
            CanFrame frame{static_cast<std::uint32_t>(random() % 0x800),
                           static_cast<std::uint8_t>(seed % 2 ? 8 : random() % 9),
                           {}};
            for (std::uint8_t& byte : frame.data) byte = static_cast<std::uint8_t>(random());
            stream.add(frame);
        }
        EXPECT_TRUE(winners(contest(stream.capture)).empty()) << "seed " << seed;
    }
}

TEST(Contest, NothingIsNothing) { EXPECT_TRUE(contest(Capture{}).empty()); }

TEST(Capture, KeepsNoMoreThanItsLimits) {
    Capture capture;
    const Chunk chunk(4000, 0x55);
    Packet packet;
    packet.data = chunk;
    for (int i = 0; i < 1000; ++i) capture.packet(packet);
    EXPECT_TRUE(capture.full());
    EXPECT_LE(capture.bytes().size(), Capture::most_bytes + chunk.size());
    packet.wire = Wire::can;
    Capture frames;
    packet.data = {};
    for (int i = 0; i < 100'000; ++i) frames.packet(packet);
    EXPECT_EQ(frames.packets(), Capture::most_packets);
}

} // namespace
} // namespace locus::sniff
