// J1939 frames of two radios and others, any data, any pauses: a byte for who and when, a byte for how long, the data.
#include "tests/fuzz/decoder_fuzz.h"

#include <array>

namespace {

constexpr std::array<std::uint32_t, 8> ids{0x18EF0180, 0x10ECFF80, 0x10EBFF80, 0x10ECFF81,
                                           0x10EBFF81, 0x10EC0180, 0x18FEF180, 0x00000123};
constexpr std::uint32_t extended = 0x80000000;

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    locus::fuzz::Result result;
    const auto decoder = locus::fuzz::decoder("pulson_can");
    locus::Packet packet;
    packet.wire = locus::Wire::can;
    for (std::span rest{data, size}; rest.size() >= 2; rest = rest.subspan(2 + packet.data.size())) {
        packet.can_id = extended | ids[rest[0] & 7];
        packet.time += std::chrono::milliseconds{rest[0] & 0xF0};
        packet.data = rest.subspan(2).first(std::min<std::size_t>(rest[1] & 15, rest.size() - 2));
        decoder->decode(packet, result);
    }
    return 0;
}
