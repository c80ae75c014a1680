#include "drivers/radio/xbee.h"

#include "drivers/frame_decoder.h"
#include "drivers/wire/checksum.h"

#include <algorithm>

namespace locus::radio {
namespace {

constexpr std::uint8_t delimiter = 0x7E, escape = 0x7D, escape_flip = 0x20;
constexpr std::size_t longest_data = 384;
constexpr std::size_t around_data = 4; // delimiter, length, checksum

bool must_escape(std::uint8_t byte) { return byte == delimiter || byte == escape || byte == 0x11 || byte == 0x13; }

/// A frame with its escapes taken out; `used` bytes of the wire went into it.
struct Plain {
    std::array<std::uint8_t, longest_data + around_data> bytes{};
    std::size_t size = 0;
    std::size_t used = 0;
    bool broken = false; ///< a delimiter inside: the frame was cut off

    std::size_t wanted() const {
        return size < 3 ? 3 : wire::big<std::uint16_t>({bytes.data(), size}, 1) + around_data;
    }
};

Plain plain_of(wire::Bytes wire_bytes, bool escaped) {
    Plain plain;
    while (plain.used < wire_bytes.size() && plain.size < std::min(plain.wanted(), plain.bytes.size())) {
        std::uint8_t byte = wire_bytes[plain.used];
        if (escaped && plain.size > 0 && byte == delimiter) return plain.broken = true, plain;
        const bool is_escape = escaped && byte == escape;
        if (is_escape && plain.used + 1 == wire_bytes.size()) return plain;
        if (is_escape) byte = wire_bytes[++plain.used] ^ escape_flip;
        ++plain.used;
        plain.bytes[plain.size++] = byte;
    }
    return plain;
}

struct XbeeFormat {
    static constexpr std::size_t max_length = 2 * (longest_data + around_data);
    bool escaped = false;

    Look look(wire::Bytes bytes) const {
        if (bytes[0] != delimiter) return Look::none(Refusal::garbage);
        const Plain plain = plain_of(bytes, escaped);
        if (plain.broken) return Look::none(Refusal::malformed);
        if (plain.wanted() > plain.bytes.size()) return Look::none(Refusal::too_long);
        if (plain.size < plain.wanted() || plain.size == 3) return Look::need(bytes.size() + 1);
        const wire::Bytes guarded{plain.bytes.data() + 3, plain.size - 3};
        return wire::sum8(guarded) == 0xFF ? Look::frame(plain.used) : Look::none(Refusal::bad_checksum);
    }
};

class Xbee : public FrameDecoder<XbeeFormat> {
  public:
    explicit Xbee(const XbeeSettings& settings) : FrameDecoder{XbeeFormat{settings.escaped}}, settings_{settings} {}

    void reset() override { FrameDecoder::reset(), awaited_.reset(), asking_ = false; }

    std::optional<Packet> request(Timestamp) override {
        if (!asking_) return std::nullopt;
        asking_ = false;
        Packet packet;
        packet.data = at_db;
        return packet;
    }

  private:
    static constexpr std::array<std::uint8_t, 8> at_db{0x7E, 0x00, 0x04, 0x08, 0x01, 0x44, 0x42, 0x70};

    void frame(const Frame& frame, MeasurementSink& sink) override {
        const Plain plain = plain_of(frame.bytes, settings_.escaped);
        const auto parsed = parse_xbee({plain.bytes.data() + 3, plain.size - around_data});
        if (!parsed) return sink.refuse(Refusal::malformed);
        sink.frame(frame.bytes);
        if (parsed->source && parsed->rssi_dbm) return tell(frame.begun, *parsed->source, *parsed->rssi_dbm, sink);
        if (parsed->source) {
            awaited_ = Awaited{frame.begun, *parsed->source};
            asking_ = settings_.ask_strength;
        } else if (parsed->rssi_dbm && awaited_) {
            tell(awaited_->time, awaited_->source, *parsed->rssi_dbm, sink);
            awaited_.reset();
        }
    }

    void tell(Timestamp time, std::uint64_t source, int rssi_dbm, MeasurementSink& sink) const {
        SignalStrength strength;
        strength.transmitter = address(source);
        strength.receiver = settings_.receiver;
        strength.rssi_dbm = static_cast<float>(rssi_dbm);
        sink.accept(time, strength);
    }

    struct Awaited {
        Timestamp time;
        std::uint64_t source;
    };
    XbeeSettings settings_;
    std::optional<Awaited> awaited_; ///< the packet whose strength AT DB will tell
    bool asking_ = false;
};

/// Source of `bytes` bytes behind the type, then the strength unless `has_rssi` is false.
std::optional<XbeeFrame> received(wire::Bytes data, std::size_t bytes, bool has_rssi) {
    if (data.size() < 1 + bytes + has_rssi) return std::nullopt;
    XbeeFrame frame{data[0], wire::big_bytes(data, 1, bytes), {}};
    if (has_rssi) frame.rssi_dbm = -static_cast<int>(data[1 + bytes]);
    return frame;
}

} // namespace

std::optional<XbeeFrame> parse_xbee(wire::Bytes data) {
    if (data.empty()) return std::nullopt;
    switch (data[0]) {
    case 0x80:
    case 0x82:
        return received(data, 8, true);
    case 0x81:
    case 0x83:
        return received(data, 2, true);
    case 0x90:
    case 0x91:
        return received(data, 8, false);
    case 0x88: { // frame id, two letters of the command, status, value
        XbeeFrame frame{data[0], {}, {}};
        if (data.size() < 5) return std::nullopt;
        if (data[2] == 'D' && data[3] == 'B' && data[4] == 0 && data.size() > 5) frame.rssi_dbm = -int{data[5]};
        return frame;
    }
    default:
        return XbeeFrame{data[0], {}, {}};
    }
}

std::vector<std::uint8_t> xbee_frame(wire::Bytes data, bool escaped) {
    wire::Writer plain;
    plain.big(static_cast<std::uint16_t>(data.size())).bytes(data);
    plain.big(static_cast<std::uint8_t>(0xFF - wire::sum8(data)));
    std::vector<std::uint8_t> out{delimiter};
    for (const std::uint8_t byte : plain.written()) {
        const bool flip = escaped && must_escape(byte);
        if (flip) out.push_back(escape);
        out.push_back(flip ? byte ^ escape_flip : byte);
    }
    return out;
}

std::vector<std::uint8_t> encode(const XbeeFrame& frame, bool escaped) {
    wire::Writer data;
    data.big(frame.type);
    if (frame.type == 0x88) data.bytes(std::array<std::uint8_t, 4>{1, 'D', 'B', 0});
    if (frame.source) data.big_bytes(*frame.source, frame.type == 0x81 || frame.type == 0x83 ? 2 : 8);
    if (frame.rssi_dbm) data.big(static_cast<std::uint8_t>(-*frame.rssi_dbm));
    return xbee_frame(data.written(), escaped);
}

std::unique_ptr<Decoder> make_xbee(const void* settings) {
    return std::make_unique<Xbee>(*static_cast<const XbeeSettings*>(settings));
}

} // namespace locus::radio
