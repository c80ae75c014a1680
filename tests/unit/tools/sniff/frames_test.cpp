// Frames of formats that nobody told us: found, described, and the description finds the very frames that were put in.
#include "config/load.h"
#include "drivers/layout/serial_format.h"
#include "drivers/wire/checksum.h"
#include "tests/examples/decoder_example.h"
#include "tests/examples/nlink_frames.h"
#include "tools/sniff/guess/frames.h"
#include "tools/sniff/guess/text.h"
#include "tools/sniff/settings_text.h"
#include "tools/sniff/words.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace locus::sniff {
namespace {

using examples::Chunk;

/// A format and one frame of it with a payload of so many bytes.
struct Design {
    std::string_view name;
    std::function<Chunk(std::mt19937&, std::uint8_t counter)> frame;
    std::string_view checksum;
    bool fixed = false;
};

void PrintTo(const Design& design, std::ostream* out) { *out << design.name; }

void add_noise(Chunk& bytes, std::size_t count, std::mt19937& random) {
    for (std::size_t i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(random()));
}

Chunk head_and_noise(std::string_view head, std::size_t payload, std::mt19937& random) {
    Chunk frame = examples::from_hex(head);
    add_noise(frame, payload, random);
    return frame;
}

void add_word(Chunk& frame, std::uint16_t word, bool big = false) {
    frame.push_back(static_cast<std::uint8_t>(big ? word >> 8 : word));
    frame.push_back(static_cast<std::uint8_t>(big ? word : word >> 8));
}

const std::vector<Design>& designs() {
    static const std::vector<Design> all{
        {"FixedWithCrc",
         [](std::mt19937& random, std::uint8_t counter) {
             Chunk frame = head_and_noise("A5 5A 10", 12, random);
             frame[3] = counter;
             add_word(frame, wire::crc16_modbus(frame));
             return frame;
         },
         "crc16_modbus", true},
        {"FixedWithBigCrcAndCalmPayload",
         [](std::mt19937& random, std::uint8_t counter) {
             Chunk frame = examples::from_hex("EB 90 01 00 00 00 00 00 00 00 07 07 00 00");
             frame[6] = counter;
             frame[8] = static_cast<std::uint8_t>(random() % 3);
             add_word(frame, wire::crc16_xmodem(frame), true);
             return frame;
         },
         "crc16_xmodem", true},
        {"LengthByteAndSum",
         [](std::mt19937& random, std::uint8_t) {
             Chunk frame = head_and_noise("AA 00", 5 + random() % 40, random);
             frame[1] = static_cast<std::uint8_t>(frame.size() - 2);
             frame.push_back(wire::sum8(frame));
             return frame;
         },
         "sum8"},
        {"LengthOfAllAndXor",
         [](std::mt19937& random, std::uint8_t counter) {
             Chunk frame = head_and_noise("55 AA 01 00 00", 8 * (1 + random() % 6), random);
             frame[5] = counter;
             frame[3] = static_cast<std::uint8_t>(frame.size() + 1);
             frame.push_back(wire::xor8(frame));
             return frame;
         },
         "xor8"},
        {"BigLengthAndFletcherBehindTheSync",
         [](std::mt19937& random, std::uint8_t) {
             Chunk frame = head_and_noise("B5 62 02 00 00", 4 + random() % 90, random);
             frame[4] = static_cast<std::uint8_t>(frame.size() - 5);
             add_word(frame, wire::fletcher8(std::span{frame}.subspan(2)));
             return frame;
         },
         "fletcher8"},
        {"SumThenLineEnd",
         [](std::mt19937& random, std::uint8_t counter) {
             Chunk frame = head_and_noise("5A A5", 10, random);
             frame[2] = counter;
             frame.push_back(wire::sum8(frame));
             frame.push_back('\r'), frame.push_back('\n');
             return frame;
         },
         "sum8", true},
        {"FixedWithoutAny",
         [](std::mt19937& random, std::uint8_t counter) {
             Chunk frame = head_and_noise("AA 25 01", 20, random);
             frame[3] = counter;
             return frame;
         },
         "none", true},
    };
    return all;
}

class Guess : public testing::TestWithParam<Design> {
  protected:
    static constexpr std::size_t frames = 120;

    /// `noisy`: every eighth frame is followed by some bytes that belong to none.
    Chunk stream(unsigned seed, bool noisy) const {
        std::mt19937 random{seed};
        Chunk bytes;
        if (noisy) add_noise(bytes, 7, random);
        for (std::size_t i = 0; i < frames; ++i) {
            const Chunk frame = GetParam().frame(random, static_cast<std::uint8_t>(i));
            bytes.insert(bytes.end(), frame.begin(), frame.end());
            if (noisy && i % 8 == 7) add_noise(bytes, 1 + random() % 9, random);
        }
        return bytes;
    }
};

TEST_P(Guess, FindsTheFramesThatWerePutIn) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const auto guess = guess_frames(stream(seed, false));
        ASSERT_TRUE(guess) << "seed " << seed;
        EXPECT_EQ(guess->frames, frames) << layout_text(guess->layout, 0);
        EXPECT_DOUBLE_EQ(guess->share, 1) << layout_text(guess->layout, 0);
        EXPECT_EQ(guess->layout.checksum, GetParam().checksum) << layout_text(guess->layout, 0);
        EXPECT_EQ(guess->layout.frame_bytes > 0, GetParam().fixed);
    }
}

TEST_P(Guess, FindsThemAmongNoise) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const auto guess = guess_frames(stream(seed, true));
        ASSERT_TRUE(guess) << "seed " << seed;
        EXPECT_EQ(guess->layout.checksum, GetParam().checksum) << layout_text(guess->layout, 0);
        if (GetParam().checksum == "none")
            EXPECT_NEAR(static_cast<double>(guess->frames), frames, 2);
        else
            EXPECT_EQ(guess->frames, frames) << layout_text(guess->layout, 0);
    }
}

TEST_P(Guess, TheSkeletonIsOneThatTheLoaderTakes) {
    const Chunk bytes = stream(1, false);
    const auto guess = guess_frames(bytes);
    ASSERT_TRUE(guess);
    const std::string yaml =
        "inputs:\n  - name: it\n    transport: fifo\n    path: /tmp/x\n    decoder: serial_layout\n" +
        layout_text(guess->layout, 4);
    const auto loaded = load_settings_text(yaml, "skeleton");
    ASSERT_TRUE(loaded.settings) << to_string(loaded.problems.front()) << "\n" << yaml;
    const InputSettings& input = loaded.settings->inputs[0];
    const auto& read = *static_cast<const layout::SerialLayoutSettings*>(input.decoder_settings.get());
    EXPECT_EQ(measured(read, bytes).frames, frames) << yaml;
}

INSTANTIATE_TEST_SUITE_P(Designs, Guess, testing::ValuesIn(designs()),
                         [](const auto& instance) { return std::string{instance.param.name}; });

TEST(GuessFrames, OfARealDevice) {
    Chunk bytes;
    std::mt19937 random{5};
    for (int i = 0; i < 60; ++i) {
        Chunk frame = examples::from_hex(examples::nlink_frames::node_frame3);
        if (i % 3 == 0) frame.erase(frame.end() - 8, frame.end() - 1); // three anchors instead of four
        for (std::size_t k = 12; k < 18; ++k) frame[k] = static_cast<std::uint8_t>(random());
        frame[2] = static_cast<std::uint8_t>(frame.size());
        frame.back() = wire::sum8(std::span{frame}.first(frame.size() - 1));
        bytes.insert(bytes.end(), frame.begin(), frame.end());
    }
    const auto guess = guess_frames(bytes);
    ASSERT_TRUE(guess);
    EXPECT_EQ(guess->frames, 60u);
    EXPECT_EQ(guess->layout.sync, "55 05");
    EXPECT_EQ(guess->layout.length_at_byte, 2);
    EXPECT_EQ(guess->layout.length_adds, 0);
    EXPECT_EQ(guess->layout.checksum, "sum8");
}

TEST(GuessFrames, WhatStandsBetweenFramesIsNoPartOfThem) {
    Chunk bytes;
    std::mt19937 random{1};
    for (int i = 0; i < 100; ++i) {
        if (i % 3 == 0) bytes.push_back(1), bytes.push_back(2);
        Chunk frame = head_and_noise("AA 55 0F", 11, random);
        frame.push_back(wire::sum8(frame));
        bytes.insert(bytes.end(), frame.begin(), frame.end());
    }
    const auto guess = guess_frames(bytes);
    ASSERT_TRUE(guess);
    EXPECT_EQ(guess->layout.frame_bytes, 15);
    EXPECT_EQ(guess->frames, 100u);
    EXPECT_EQ(guess->layout.checksum, "sum8");
}

TEST(GuessFrames, NothingIsSeenInNoise) {
    for (unsigned seed = 0; seed < 60; ++seed) {
        std::mt19937 random{seed};
        Chunk bytes;
        for (std::size_t i = 0; i < 6000; ++i)
            bytes.push_back(static_cast<std::uint8_t>(seed % 3 == 0   ? random()
                                                      : seed % 3 == 1 ? random() % 4
                                                                      : ' ' + random() % 60));
        EXPECT_FALSE(guess_frames(bytes)) << "seed " << seed;
    }
}

TEST(GuessFrames, NothingIsSeenInSilenceOrInWhatOnlyRepeats) {
    EXPECT_FALSE(guess_frames({}));
    EXPECT_FALSE(guess_frames(Chunk(5000, 0)));
    Chunk alike;
    for (int i = 0; i < 500; ++i)
        for (const int byte : {0xAA, 0x55, 1, 2, 3, 4, 5, 6}) alike.push_back(static_cast<std::uint8_t>(byte));
    EXPECT_FALSE(guess_frames(alike));
    EXPECT_FALSE(guess_frames(Chunk{1}));
}

TEST(Text, IsToldFromBinary) {
    EXPECT_TRUE(is_text(wire::bytes_of("mc 0f 00001d3c\r\nmc 07\r\n")));
    EXPECT_FALSE(is_text(wire::bytes_of({"\x55\x05\x00\x01\x02", 5})));
    EXPECT_FALSE(is_text({}));
    const TextLines lines = lines_of(wire::bytes_of("cut off\r\nmc 0f 00001d3c\r\n\r\nmc\t07\nun"));
    EXPECT_EQ(lines.lines, 3u);
    EXPECT_EQ(lines.longest, 14u);
    EXPECT_EQ(lines.first, (std::vector<std::string>{"mc 0f 00001d3c", "mc.07"}));
}

} // namespace
} // namespace locus::sniff
