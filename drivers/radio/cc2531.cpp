// A record: type, length of the rest (2 bytes), then for packets a timestamp (4), the length on the air, and the frame.
#include "drivers/radio/cc2531.h"

#include "drivers/frame_decoder.h"
#include "drivers/radio/mac_header.h"

namespace locus::radio {
namespace {

constexpr std::uint8_t packet_record = 0, tick_record = 1;
constexpr std::size_t record_head = 3, packet_head = 8, longest_on_air = 127, longest_tick = 16;
constexpr std::size_t shortest_on_air = 5; ///< an acknowledgement, with its FCS

struct Cc2531Format {
    static constexpr std::size_t max_length = packet_head + longest_on_air;

    Look look(wire::Bytes bytes) const {
        if (bytes[0] != packet_record && bytes[0] != tick_record) return Look::none(Refusal::garbage);
        if (bytes.size() < record_head) return Look::need(record_head);
        const std::size_t rest = wire::little<std::uint16_t>(bytes, 1);
        return bytes[0] == tick_record ? look_at_tick(bytes, rest) : look_at_packet(bytes, rest);
    }

  private:
    static Look look_at_tick(wire::Bytes bytes, std::size_t rest) {
        if (rest == 0 || rest > longest_tick) return Look::none(Refusal::garbage);
        return bytes.size() < record_head + rest ? Look::need(record_head + rest) : Look::frame(record_head + rest);
    }

    /// Both lengths must agree: the only sign that a record is one.
    static Look look_at_packet(wire::Bytes bytes, std::size_t rest) {
        if (bytes.size() < packet_head) return Look::need(packet_head);
        const std::size_t on_air = bytes[packet_head - 1];
        const bool fits = on_air >= shortest_on_air && on_air <= longest_on_air;
        if (!fits || rest != packet_head - record_head + on_air) return Look::none(Refusal::garbage);
        return bytes.size() < packet_head + on_air ? Look::need(packet_head + on_air)
                                                   : Look::frame(packet_head + on_air);
    }
};

class Cc2531 : public FrameDecoder<Cc2531Format> {
  public:
    explicit Cc2531(const Cc2531Settings& settings) : settings_{settings} {}

  private:
    void frame(const Frame& frame, MeasurementSink& sink) override {
        if (frame.bytes[0] == tick_record) return sink.frame(frame.bytes);
        const Cc2531Record record = parse_cc2531(frame.bytes);
        if (!record.crc_good) return sink.refuse(Refusal::bad_checksum);
        const auto header = parse_mac_header(record.frame);
        if (!header) return sink.refuse(Refusal::unknown_type);
        sink.frame(frame.bytes);
        if (!header->source) return; // an acknowledgement does not say whose it is
        SignalStrength strength;
        strength.transmitter = address(header->source->address);
        strength.receiver = settings_.receiver;
        strength.rssi_dbm = static_cast<float>(record.raw_rssi + settings_.rssi_offset_db);
        sink.accept(frame.begun, strength);
    }

    Cc2531Settings settings_;
};

} // namespace

Cc2531Record parse_cc2531(wire::Bytes bytes) {
    const wire::Bytes on_air = bytes.subspan(packet_head);
    const wire::Bytes measured = on_air.last(2);
    return {wire::little<std::uint32_t>(bytes, record_head), on_air.first(on_air.size() - 2),
            static_cast<std::int8_t>(measured[0]), (measured[1] & 0x80) != 0,
            static_cast<std::uint8_t>(measured[1] & 0x7F)};
}

std::vector<std::uint8_t> encode(const Cc2531Record& record) {
    const auto on_air = static_cast<std::uint8_t>(record.frame.size() + 2);
    wire::Writer out;
    out.little(packet_record).little(static_cast<std::uint16_t>(packet_head - record_head + on_air));
    out.little(record.timestamp_ticks).little(on_air).bytes(record.frame).little(record.raw_rssi);
    return out.little(static_cast<std::uint8_t>(record.correlation | (record.crc_good ? 0x80 : 0))).take();
}

std::unique_ptr<Decoder> make_cc2531(const void* settings) {
    return std::make_unique<Cc2531>(*static_cast<const Cc2531Settings*>(settings));
}

} // namespace locus::radio
