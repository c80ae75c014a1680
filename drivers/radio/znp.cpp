#include "drivers/radio/znp.h"

#include "drivers/frame_decoder.h"
#include "drivers/wire/checksum.h"

namespace locus::radio {
namespace {

constexpr std::uint8_t start_of_frame = 0xFE;
constexpr std::uint8_t af_incoming[2]{0x44, 0x81};
constexpr std::size_t head = 4; // start, length, two bytes of command
constexpr std::size_t longest_znp_data = 250;

struct ZnpFormat {
    static constexpr std::size_t max_length = head + longest_znp_data + 1;

    Look look(wire::Bytes bytes) const {
        if (bytes[0] != start_of_frame) return Look::none(Refusal::garbage);
        if (bytes.size() < 2) return Look::need(2);
        if (bytes[1] > longest_znp_data) return Look::none(Refusal::too_long);
        const std::size_t length = head + bytes[1] + 1;
        if (bytes.size() < length) return Look::need(length);
        const bool good = wire::xor8(bytes.subspan(1, length - 1)) == 0;
        return good ? Look::frame(length) : Look::none(Refusal::bad_checksum);
    }
};

class Znp : public FrameDecoder<ZnpFormat> {
  public:
    explicit Znp(const ZnpSettings& settings) : settings_{settings} {}

  private:
    void frame(const Frame& frame, MeasurementSink& sink) override {
        sink.frame(frame.bytes);
        const auto incoming = parse_znp_incoming(frame.bytes);
        if (!incoming) return;
        SignalStrength strength;
        strength.transmitter = address(incoming->source);
        strength.receiver = settings_.receiver;
        strength.rssi_dbm = static_cast<float>(settings_.lqi_zero_dbm + settings_.lqi_step_db * incoming->link_quality);
        sink.accept(frame.begun, strength);
    }

    ZnpSettings settings_;
};

} // namespace

std::optional<ZnpIncoming> parse_znp_incoming(wire::Bytes frame) {
    constexpr std::size_t shortest_data = 15; // up to the timestamp's end
    if (frame.size() < head + shortest_data + 1 || frame[2] != af_incoming[0] || frame[3] != af_incoming[1])
        return std::nullopt;
    const wire::Bytes data = frame.subspan(head);
    return ZnpIncoming{wire::little<std::uint16_t>(data, 2), wire::little<std::uint16_t>(data, 4), data[9],
                       wire::little<std::uint32_t>(data, 11)};
}

std::vector<std::uint8_t> znp_frame(std::uint8_t command0, std::uint8_t command1, wire::Bytes data) {
    wire::Writer out;
    out.little(static_cast<std::uint8_t>(data.size())).little(command0).little(command1).bytes(data);
    const std::uint8_t checksum = wire::xor8(out.written());
    return wire::Writer{}.little(start_of_frame).bytes(out.written()).little(checksum).take();
}

std::vector<std::uint8_t> encode(const ZnpIncoming& incoming) {
    wire::Writer data;
    data.zeros(2).little(incoming.cluster).little(incoming.source).zeros(3).little(incoming.link_quality).zeros(1);
    data.little(incoming.timestamp).zeros(2);
    return znp_frame(af_incoming[0], af_incoming[1], data.written());
}

std::unique_ptr<Decoder> make_znp(const void* settings) {
    return std::make_unique<Znp>(*static_cast<const ZnpSettings*>(settings));
}

} // namespace locus::radio
