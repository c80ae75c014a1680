#include "drivers/uwb/pulson/pulson_can.h"

#include "drivers/j1939/broadcasts.h"
#include "drivers/uwb/pulson/radio.h"

#include <algorithm>

namespace locus::uwb::pulson {
namespace {

constexpr std::uint32_t group = 0xEF00;        // "proprietary A"
constexpr std::uint8_t broadcast_priority = 4; // as the radio sends them
constexpr std::size_t frame_room = 8;

class Can : public Decoder {
  public:
    explicit Can(const PulsonSettings& settings)
        : address_{static_cast<std::uint8_t>(settings.can_address)},
          host_{static_cast<std::uint8_t>(settings.host_address)}, radio_{settings} {}

    void decode(const Packet& packet, MeasurementSink& sink) override {
        const auto id = j1939::identifier(packet.can_id);
        if (!id || id->source != address_) return;
        if (id->group == group) return radio_.message(packet.data, packet.time, sink);
        switch (broadcasts_.take(*id, packet)) {
        case j1939::Broadcasts::Outcome::refused:
            return sink.refuse(Refusal::malformed);
        case j1939::Broadcasts::Outcome::whole:
            return whole(broadcasts_.message(), sink);
        default:
            return;
        }
    }

    void reset() override {
        broadcasts_.reset();
        radio_.reset();
    }

    std::optional<Packet> request(Timestamp now) override {
        const auto message = radio_.request(now);
        if (!message) return std::nullopt;
        greeting_ = can_frames(*message, host_, address_).front(); // it is short: settings on CAN have no responders
        return greeting_.packet(now);
    }

  private:
    /// Other groups are none of ours.
    void whole(const j1939::Message& message, MeasurementSink& sink) {
        if ((message.group & ~0xFFu) == group) radio_.message(message.data, message.begun, sink);
    }

    std::uint8_t address_;
    std::uint8_t host_;
    CanFrame greeting_{};
    j1939::Broadcasts broadcasts_;
    Radio radio_;
};

} // namespace

std::vector<CanFrame> can_frames(wire::Bytes message, std::uint8_t from, std::uint8_t to) {
    if (message.size() > frame_room) return j1939::broadcast(group | to, from, message, broadcast_priority);
    CanFrame frame{j1939::can_id({6, group, from, to}), static_cast<std::uint8_t>(message.size()), {}};
    std::ranges::copy(message, frame.data.begin());
    return {frame};
}

std::unique_ptr<Decoder> make_can(const void* settings) {
    return std::make_unique<Can>(*static_cast<const PulsonSettings*>(settings));
}

} // namespace locus::uwb::pulson
