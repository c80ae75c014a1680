// Every byte format after damage: what comes intact is delivered, and where there is a checksum nothing else is.
#include "drivers/recording/measurement_json.h"
#include "tests/examples/decoder_example.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>

#include <random>

namespace locus {
namespace {

using examples::Chunk;
using examples::DecoderExample;
using Lines = std::vector<std::string>; // measurements as text, which compares and prints

class Resync : public testing::TestWithParam<DecoderExample> {
  protected:
    static Lines said(const test::Collector& sink) {
        Lines lines;
        for (const auto& item : sink.items) lines.push_back(to_json_line({{}, 0, 0, item.observation}));
        return lines;
    }

    Lines decode(const std::vector<Chunk>& stream, Duration apart) const {
        const auto decoder = GetParam().make();
        test::Collector sink;
        Timestamp time{};
        for (const Chunk& piece : stream) decoder->decode(test::bytes_packet(piece, time += apart), sink);
        for (auto& item : sink.items) item.time = {};
        return said(sink);
    }
    Lines decode(const std::vector<Chunk>& stream) const { return decode(stream, GetParam().apart); }

    /// The example's chunks, then 4 kB more, so that no false head waits for the end of what it claims.
    std::vector<Chunk> stream() const {
        std::vector<Chunk> chunks = GetParam().chunks;
        for (std::size_t bytes = 0; bytes < 4096; bytes += GetParam().chunks[0].size()) chunks.push_back(chunks[0]);
        return chunks;
    }

    /// Whether all of `wanted` stands in `got`, in order.
    static bool holds(const Lines& got, const Lines& wanted) {
        auto at = got.begin();
        for (const std::string& line : wanted) {
            at = std::find(at, got.end(), line);
            if (at == got.end()) return false;
            ++at;
        }
        return true;
    }

    static Chunk joined(const std::vector<Chunk>& chunks) {
        Chunk all;
        for (const Chunk& chunk : chunks) all.insert(all.end(), chunk.begin(), chunk.end());
        return all;
    }

    Chunk garbage(std::mt19937& random) const {
        Chunk bytes(random() % 40);
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
        if (GetParam().lines) bytes.push_back('\n');
        return bytes;
    }
};

TEST_P(Resync, ItDoesNotMatterWhereTheStreamIsCut) {
    const Chunk all = joined(GetParam().chunks);
    const Lines whole = decode({all}, {});
    ASSERT_FALSE(whole.empty());
    const std::size_t until = std::min<std::size_t>(all.size(), 1000);
    for (std::size_t i = 1; i < until; ++i) {
        const auto cut = all.begin() + static_cast<std::ptrdiff_t>(i);
        ASSERT_TRUE(decode({Chunk(all.begin(), cut), Chunk(cut, all.end())}, {}) == whole) << "cut at byte " << i;
    }
}

TEST_P(Resync, GarbageBetweenFramesCostsNoFrame) {
    std::mt19937 random{7};
    for (int round = 0; round < 50; ++round) {
        std::vector<Chunk> damaged;
        const auto chunks = stream();
        for (std::size_t i = 0; i < chunks.size(); ++i) {
            if (i <= GetParam().chunks.size()) damaged.push_back(garbage(random));
            damaged.push_back(chunks[i]);
        }
        const Lines got = decode(damaged), wanted = decode(chunks);
        if (GetParam().weak)
            EXPECT_NEAR(static_cast<double>(got.size()), static_cast<double>(wanted.size()),
                        0.02 * static_cast<double>(wanted.size()));
        else if (GetParam().checksum)
            EXPECT_TRUE(got == wanted) << got.size() << " measurements, " << wanted.size() << " wanted";
        else
            EXPECT_TRUE(holds(got, decode(GetParam().chunks)));
    }
}

TEST_P(Resync, ALostByteCostsItsOwnFrameAlone) {
    const auto intact = stream();
    const std::size_t hit = GetParam().chunks.size() / 2;
    auto others = intact;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(hit));
    // Without a checksum the damaged frame is believed, with the first byte of the next one as its last.
    if (!GetParam().checksum && !GetParam().lines) others.erase(others.begin() + static_cast<std::ptrdiff_t>(hit));
    const std::size_t cuttable = intact[hit].size() - GetParam().lines; // without its newline a line swallows the next
    for (std::size_t i = 0; i < cuttable; ++i) {
        auto damaged = intact;
        damaged[hit].erase(damaged[hit].begin() + static_cast<std::ptrdiff_t>(i));
        if (GetParam().checksum)
            ASSERT_TRUE(decode(damaged) == decode(others)) << "without byte " << i;
        else
            ASSERT_TRUE(holds(decode(damaged), decode(others))) << "without byte " << i;
    }
}

std::vector<DecoderExample> of_bytes() {
    std::vector<DecoderExample> some;
    for (const DecoderExample& example : examples::all())
        if (!example.chunks.empty() && !example.datagrams) some.push_back(example);
    return some;
}

INSTANTIATE_TEST_SUITE_P(Decoders, Resync, testing::ValuesIn(of_bytes()), [](const auto& instance) {
    return std::string{instance.param.decoder} + "_" + std::to_string(instance.index);
});

} // namespace
} // namespace locus
