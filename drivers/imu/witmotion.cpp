// WitMotion frames and the decoders of their two wires.
#include "drivers/imu/witmotion.h"

#include "drivers/wire/checksum.h"
#include "drivers/wire/frame_stream.h"
#include "fusion/units.h"

#include <algorithm>
#include <cmath>

namespace locus::imu {
namespace {

constexpr std::uint8_t wit_head = 0x55;
constexpr double wit_force_step_mps2 = 16 * standard_gravity_mps2 / 32768;
constexpr double wit_rate_step_radps = 2000 * rad_per_deg / 32768;

constexpr bool is_wit_type(std::uint8_t type) { return type >= WitFrame::first && type <= WitFrame::last; }

Vec3 scaled(const WitFrame& frame, double step) {
    return {frame.words[0] * step, frame.words[1] * step, frame.words[2] * step};
}

WitFrame wit_steps(WitFrame::Type type, const Vec3& values, double step) {
    WitFrame frame{type, {}};
    for (std::size_t i = 0; i < 3; ++i)
        frame.words[i] = static_cast<std::int16_t>(std::clamp(std::round(values[i] / step), -32768.0, 32767.0));
    return frame;
}

struct WitFormat {
    static constexpr std::size_t max_length = wit_frame_length;

    Look look(wire::Bytes bytes) const {
        if (bytes[0] != wit_head) return Look::none(Refusal::garbage);
        if (bytes.size() < 2) return Look::need(2);
        if (!is_wit_type(bytes[1])) return Look::none(Refusal::garbage);
        if (bytes.size() < wit_frame_length) return Look::need(wit_frame_length);
        if (wire::sum8(bytes.first(wit_frame_length - 1)) != bytes[wit_frame_length - 1])
            return Look::none(Refusal::bad_checksum);
        return Look::frame(wit_frame_length);
    }
};

class WitMotion : public Decoder {
  public:
    explicit WitMotion(const WitMotionSettings& settings) : sample_(settings) {}

    void decode(const Packet& packet, MeasurementSink& sink) override {
        stream_.feed(
            packet,
            [&](const Frame& frame) {
                sink.frame(frame.bytes);
                sample_.take(parse_wit_frame(frame.bytes.first<wit_frame_length>()), frame.begun, sink);
            },
            [&](Refusal reason) {
                sample_.forget();
                sink.refuse(reason);
            });
    }

    void reset() override {
        stream_.reset();
        sample_.forget();
    }

  private:
    FrameStream<WitFormat> stream_;
    WitSample sample_;
};

class WitMotionCan : public Decoder {
  public:
    explicit WitMotionCan(const WitMotionCanSettings& settings)
        : id_(static_cast<std::uint32_t>(settings.can_id)), sample_(settings) {}

    void decode(const Packet& packet, MeasurementSink& sink) override {
        if (packet.can_id != id_) return;
        if (packet.data.size() != 8 || packet.data[0] != wit_head) {
            sample_.forget();
            return sink.refuse(Refusal::malformed);
        }
        if (!is_wit_type(packet.data[1])) return sink.refuse(Refusal::unknown_type);
        sink.frame(packet.data);
        WitFrame frame{packet.data[1], {}};
        if (frame.type == WitFrame::pressure) return sample_.forget();
        for (std::size_t i = 0; i < 3; ++i) frame.words[i] = wire::little<std::int16_t>(packet.data, 2 + 2 * i);
        sample_.take(frame, packet.time, sink);
    }

    void reset() override { sample_.forget(); }

  private:
    std::uint32_t id_;
    WitSample sample_;
};

} // namespace

WitFrame parse_wit_frame(std::span<const std::uint8_t, wit_frame_length> bytes) {
    WitFrame frame{bytes[1], {}};
    for (std::size_t i = 0; i < 4; ++i) frame.words[i] = wire::little<std::int16_t>(bytes, 2 + 2 * i);
    return frame;
}

std::array<std::uint8_t, wit_frame_length> encode(const WitFrame& frame) {
    std::array<std::uint8_t, wit_frame_length> bytes{wit_head, frame.type};
    for (std::size_t i = 0; i < 8; ++i) bytes[2 + i] = static_cast<std::uint8_t>(frame.words[i / 2] >> (8 * (i % 2)));
    bytes.back() = wire::sum8(wire::Bytes{bytes}.first(wit_frame_length - 1));
    return bytes;
}

CanFrame encode_can(const WitFrame& frame, int can_id) {
    const auto bytes = encode(frame);
    CanFrame can{static_cast<std::uint32_t>(can_id), 8, {}};
    std::copy_n(bytes.begin(), can.data.size(), can.data.begin());
    return can;
}

WitFrame wit_acceleration(const Vec3& force_mps2) {
    return wit_steps(WitFrame::acceleration, force_mps2, wit_force_step_mps2);
}
WitFrame wit_rate(const Vec3& rate_radps) { return wit_steps(WitFrame::rate, rate_radps, wit_rate_step_radps); }
WitFrame wit_pressure(std::int32_t pressure_pa) {
    return {WitFrame::pressure,
            {static_cast<std::int16_t>(pressure_pa), static_cast<std::int16_t>(pressure_pa >> 16), 0, 0}};
}

/// Between the acceleration and the rate of a cycle nothing comes: else one of the two was lost.
void WitSample::take(const WitFrame& frame, Timestamp begun, MeasurementSink& sink) {
    if (has_acceleration_ && frame.type != WitFrame::rate) sink.refuse(Refusal::malformed);
    if (frame.type == WitFrame::rate) give(frame, sink);
    has_acceleration_ = frame.type == WitFrame::acceleration;
    if (has_acceleration_) acceleration_ = frame, begun_ = begun;
    if (frame.type == WitFrame::pressure)
        mounting_.give_pressure(begun, static_cast<std::uint16_t>(frame.words[0]) + 65536.0 * frame.words[1], sink);
}

void WitSample::give(const WitFrame& rate, MeasurementSink& sink) {
    if (!has_acceleration_) return sink.refuse(Refusal::malformed);
    mounting_.give(begun_, scaled(acceleration_, wit_force_step_mps2), scaled(rate, wit_rate_step_radps), sink);
}

std::unique_ptr<Decoder> make_witmotion(const void* settings) {
    return std::make_unique<WitMotion>(*static_cast<const WitMotionSettings*>(settings));
}

std::unique_ptr<Decoder> make_witmotion_can(const void* settings) {
    return std::make_unique<WitMotionCan>(*static_cast<const WitMotionCanSettings*>(settings));
}

} // namespace locus::imu
