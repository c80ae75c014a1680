// 802.15.4 frames: layouts in ieee802154.h.
#include "drivers/uwb/ieee802154.h"

#include "drivers/wire/checksum.h"

#include <algorithm>

namespace locus::uwb::ieee802154 {
namespace {

using wire::little;

constexpr std::uint8_t blink_control = 0xC5;
constexpr std::uint16_t data_control = 0x8841; // data, PAN compressed, short addresses
constexpr std::size_t data_header = 9;

} // namespace

bool Data::operator==(const Data& other) const {
    return sequence == other.sequence && pan == other.pan && destination == other.destination &&
           source == other.source && std::ranges::equal(payload, other.payload);
}

std::optional<Blink> parse_blink(std::span<const std::uint8_t> frame) {
    if (frame.size() != 10 || frame[0] != blink_control) return std::nullopt;
    return Blink{frame[1], little<std::uint64_t>(frame, 2)};
}

std::optional<ClockCalibration> parse_clock_calibration(std::span<const std::uint8_t> frame) {
    if ((frame.size() != 30 && frame.size() != 32) || frame[0] != blink_control) return std::nullopt;
    ClockCalibration packet{frame[1],
                            little<std::uint64_t>(frame, 2),
                            little<std::uint16_t>(frame, 10),
                            little<std::uint64_t>(frame, 12),
                            little<std::uint64_t>(frame, 20),
                            frame[28],
                            frame[29],
                            {}};
    if (frame.size() == 32) packet.epoch_offset_us = little<std::uint16_t>(frame, 30);
    return packet;
}

std::optional<Data> parse_data(std::span<const std::uint8_t> frame) {
    if (frame.size() < data_header || little<std::uint16_t>(frame, 0) != data_control) return std::nullopt;
    return Data{frame[2], little<std::uint16_t>(frame, 3), little<std::uint16_t>(frame, 5),
                little<std::uint16_t>(frame, 7), frame.subspan(data_header)};
}

std::vector<std::uint8_t> encode(const Blink& blink) {
    return wire::Writer{}.little(blink_control).little(blink.sequence).little(blink.eui).take();
}

std::vector<std::uint8_t> encode(const ClockCalibration& packet) {
    wire::Writer out;
    out.little(blink_control).little(packet.sequence).little(packet.eui).little(packet.short_address);
    out.little(packet.interval_ticks_in_master).little(packet.sent_ticks_in_master);
    out.little(packet.repetition).little(packet.repetitions);
    if (packet.epoch_offset_us) out.little(*packet.epoch_offset_us);
    return out.take();
}

std::vector<std::uint8_t> encode(const Data& data) {
    wire::Writer out;
    out.little(data_control).little(data.sequence).little(data.pan).little(data.destination).little(data.source);
    return out.bytes(data.payload).take();
}

std::optional<std::span<const std::uint8_t>> without_fcs(std::span<const std::uint8_t> frame) {
    if (frame.size() < 2) return std::nullopt;
    const auto body = frame.first(frame.size() - 2);
    if (wire::crc16_kermit(body) != little<std::uint16_t>(frame, body.size())) return std::nullopt;
    return body;
}

std::vector<std::uint8_t> with_fcs(std::vector<std::uint8_t> frame) {
    const std::uint16_t fcs = wire::crc16_kermit(frame);
    frame.push_back(static_cast<std::uint8_t>(fcs));
    frame.push_back(static_cast<std::uint8_t>(fcs >> 8));
    return frame;
}

} // namespace locus::uwb::ieee802154
