#include "drivers/uwb/loco_packets.h"

namespace locus::uwb::loco {
namespace {

constexpr std::uint8_t tdoa2_type = 0x22, tdoa3_type = 0x30, first_two_way = 0x01, last_two_way = 0x04;
constexpr std::size_t stamps_at = 9, distances_at = 41, tdoa2_bytes = 57;
constexpr std::size_t tdoa3_head = 7, remote_bytes = 6;
constexpr std::uint8_t has_distance = 0x80, packet_mask = 0x7F;

std::optional<Payload> parse_tdoa2(wire::Bytes payload) {
    if (payload.size() < tdoa2_bytes) return std::nullopt;
    Tdoa2 packet;
    for (std::size_t i = 0; i < anchors_of_tdoa2; ++i) {
        packet.packets[i] = payload[1 + i];
        packet.ticks_in_sender[i] = wire::little<std::uint32_t>(payload, stamps_at + 4 * i);
        packet.distance_ticks[i] = wire::little<std::uint16_t>(payload, distances_at + 2 * i);
    }
    return packet;
}

std::optional<Payload> parse_tdoa3(wire::Bytes payload) {
    if (payload.size() < tdoa3_head || payload[tdoa3_head - 1] > most_remotes) return std::nullopt;
    Tdoa3 packet{static_cast<std::uint8_t>(payload[1] & packet_mask), wire::little<std::uint32_t>(payload, 2), {}, 0};
    packet.remote_count = payload[tdoa3_head - 1];
    std::size_t at = tdoa3_head;
    for (std::size_t i = 0; i < packet.remote_count; ++i) {
        if (payload.size() < at + remote_bytes) return std::nullopt;
        Tdoa3::Remote& remote = packet.remotes[i];
        remote = {payload[at], static_cast<std::uint8_t>(payload[at + 1] & packet_mask),
                  wire::little<std::uint32_t>(payload, at + 2), 0};
        const bool with_distance = (payload[at + 1] & has_distance) != 0;
        at += remote_bytes;
        if (!with_distance) continue;
        if (payload.size() < at + 2) return std::nullopt;
        remote.distance_ticks = wire::little<std::uint16_t>(payload, at);
        at += 2;
    }
    return packet;
}

} // namespace

std::optional<Payload> parse(wire::Bytes payload) {
    if (payload.empty()) return std::nullopt;
    if (payload[0] == tdoa2_type) return parse_tdoa2(payload);
    if (payload[0] == tdoa3_type) return parse_tdoa3(payload);
    if (payload[0] >= first_two_way && payload[0] <= last_two_way) return TwoWay{payload[0]};
    return std::nullopt;
}

std::vector<std::uint8_t> encode(const Tdoa2& packet) {
    wire::Writer out;
    out.little(tdoa2_type).bytes(packet.packets);
    for (const std::uint32_t ticks : packet.ticks_in_sender) out.little(ticks);
    for (const std::uint16_t ticks : packet.distance_ticks) out.little(ticks);
    return out.take();
}

std::vector<std::uint8_t> encode(const Tdoa3& packet) {
    wire::Writer out;
    out.little(tdoa3_type).little(packet.packet).little(packet.tx_ticks_in_sender);
    out.little(static_cast<std::uint8_t>(packet.remote_count));
    for (std::size_t i = 0; i < packet.remote_count; ++i) {
        const Tdoa3::Remote& remote = packet.remotes[i];
        const bool with_distance = remote.distance_ticks != 0;
        out.little(remote.anchor).little(static_cast<std::uint8_t>(remote.packet | (with_distance ? has_distance : 0)));
        out.little(remote.rx_ticks_in_sender);
        if (with_distance) out.little(remote.distance_ticks);
    }
    return out.take();
}

} // namespace locus::uwb::loco
