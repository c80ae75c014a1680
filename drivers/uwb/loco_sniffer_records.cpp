// What the sniffer prints of a packet, in both its forms.
#include "drivers/uwb/loco_sniffer.h"
#include "drivers/wire/text.h"

#include <fmt/format.h>

namespace locus::uwb::loco {
namespace {

constexpr std::uint8_t record_begin = 0xBC;
constexpr std::size_t payload_at = 10;

} // namespace

std::optional<Sniffed> parse_record(wire::Bytes record) {
    const std::size_t length = wire::little<std::uint16_t>(record, 8);
    if (record.size() != payload_at + length + 2 || length > longest_payload) return std::nullopt;
    if (wire::little<std::uint16_t>(record, payload_at + length) != length) return std::nullopt;
    return Sniffed{wire::little_bytes(record, 1, 5), record[6], record[7], record.subspan(payload_at, length)};
}

std::vector<std::uint8_t> encode_record(const Sniffed& packet) {
    const auto length = static_cast<std::uint16_t>(packet.payload.size());
    wire::Writer out;
    out.little(record_begin).little_bytes(packet.rx_ticks, 5).little(packet.from).little(packet.to).little(length);
    return out.bytes(packet.payload).little(length).take();
}

std::optional<Sniffed> parse_line(std::string_view line, std::array<std::uint8_t, longest_payload>& buffer) {
    wire::Text text{line};
    Sniffed packet;
    const bool head = text.literal("From ") && text.hex(2, packet.from) && text.literal(" to ") &&
                      text.hex(2, packet.to) && text.literal(" @") && text.hex(10, packet.rx_ticks) &&
                      text.literal(": ");
    if (!head) return std::nullopt;
    const std::size_t count = text.hex_digits() / 2;
    if (count > buffer.size()) return std::nullopt;
    for (std::size_t i = 0; i < count; ++i)
        if (!text.hex_byte(buffer[i])) return std::nullopt;
    if (!text.done()) return std::nullopt;
    packet.payload = wire::Bytes{buffer}.first(count);
    return packet;
}

std::string encode_line(const Sniffed& packet) {
    return fmt::format("From {:02x} to {:02x} @{:010x}: {:02x}\r\n", packet.from, packet.to, packet.rx_ticks,
                       fmt::join(packet.payload, ""));
}

} // namespace locus::uwb::loco
