#include "drivers/uwb/loco_sniffer.h"

#include "drivers/uwb/loco_packets.h"
#include "tests/examples/decoder_example.h"

namespace locus::examples {

std::vector<DecoderExample> loco_sniffer();

namespace {

constexpr std::uint32_t slot_ticks = 1u << 27;

/// Two anchors in turn with perfect clocks, and the listener's beside them.
Chunk sniffed(std::uint32_t slot, bool binary) {
    const auto from = static_cast<std::uint8_t>(slot % 2), other = static_cast<std::uint8_t>(1 - from);
    uwb::loco::Tdoa3 packet{static_cast<std::uint8_t>(slot & 0x7F), slot * slot_ticks, {}, 1};
    packet.remotes[0] = {other, static_cast<std::uint8_t>((slot - 1) & 0x7F), (slot - 1) * slot_ticks + 1066, 34017};
    const Chunk payload = encode(packet);
    const uwb::loco::Sniffed heard{std::uint64_t{slot} * slot_ticks + 32951 + 500u * from, from, 0xFF, payload};
    return binary ? encode_record(heard) : chunk(encode_line(heard));
}

DecoderExample form(bool binary) {
    DecoderExample example{"loco_sniffer"};
    // A chunk has a packet that gives a difference: the third of each anchor.
    for (std::uint32_t i = 0; i < 20; ++i) {
        Chunk several;
        for (std::uint32_t slot = 1; slot <= 6; ++slot) {
            const Chunk one = sniffed(slot, binary);
            several.insert(several.end(), one.begin(), one.end());
        }
        example.chunks.push_back(several);
    }
    example.lines = !binary;
    example.checksum = false;
    return example;
}

} // namespace

std::vector<DecoderExample> loco_sniffer() { return {form(true), form(false)}; }

} // namespace locus::examples
