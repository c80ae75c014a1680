#include "drivers/uwb/pulson/pulson.h"

#include "drivers/frame_decoder.h"
#include "drivers/uwb/pulson/envelope.h"
#include "drivers/uwb/pulson/radio.h"

namespace locus::uwb::pulson {
namespace {

template <FrameFormat Format>
class Serial : public FrameDecoder<Format> {
  public:
    explicit Serial(const PulsonSettings& settings) : radio_{settings} {}

    void reset() override {
        FrameDecoder<Format>::reset();
        radio_.reset();
    }

    std::optional<Packet> request(Timestamp now) override {
        const auto message = radio_.request(now);
        if (!message) return std::nullopt;
        request_ = Format::wrap(*message);
        Packet packet;
        packet.data = request_;
        return packet;
    }

  private:
    Radio radio_;
    std::vector<std::uint8_t> request_;

    void frame(const Frame& frame, MeasurementSink& sink) override {
        radio_.message(Format::message(frame.bytes), frame.begun, sink);
    }
};

/// Over UDP there is no envelope: a packet is a message.
class Datagrams : public Decoder {
  public:
    explicit Datagrams(const PulsonSettings& settings) : radio_{settings} {}

    void decode(const Packet& packet, MeasurementSink& sink) override {
        radio_.message(packet.data, packet.time, sink);
    }

    void reset() override { radio_.reset(); }

    std::optional<Packet> request(Timestamp now) override {
        auto message = radio_.request(now);
        if (!message) return std::nullopt;
        request_ = std::move(*message);
        Packet packet;
        packet.data = request_;
        return packet;
    }

  private:
    Radio radio_;
    std::vector<std::uint8_t> request_;
};

template <class Format>
std::unique_ptr<Decoder> make(const void* settings) {
    return std::make_unique<Serial<Format>>(*static_cast<const PulsonSettings*>(settings));
}

} // namespace

std::unique_ptr<Decoder> make_usb(const void* settings) { return make<UsbFormat>(settings); }
std::unique_ptr<Decoder> make_uart(const void* settings) { return make<UartFormat>(settings); }
std::unique_ptr<Decoder> make_udp(const void* settings) {
    return std::make_unique<Datagrams>(*static_cast<const PulsonSettings*>(settings));
}

} // namespace locus::uwb::pulson
