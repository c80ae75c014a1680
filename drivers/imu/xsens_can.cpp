// Groups of CAN frames of an Xsens MTi, and their samples.
#include "drivers/imu/xsens_can.h"

#include "drivers/device_clock.h"
#include "drivers/wire/bytes.h"

#include <algorithm>
#include <cmath>

namespace locus::imu {
namespace {

namespace id = xsens_can;

constexpr double xsens_rate_step_radps = 1.0 / 512;
constexpr double xsens_force_step_mps2 = 1.0 / 256;
constexpr double xsens_pressure_step_pa = 1.0 / 32768;

/// Length of a frame that we take; none for those that we do not.
std::optional<std::size_t> length_of(std::uint32_t can_id) {
    switch (can_id) {
    case id::sample_time:
    case id::pressure:
        return 4;
    case id::group_counter:
        return 2;
    case id::rate_of_turn:
    case id::acceleration:
        return 6;
    default:
        return std::nullopt;
    }
}

Vec3 read_steps(wire::Bytes data, double step) {
    Vec3 vector{};
    for (std::size_t i = 0; i < 3; ++i) vector[i] = step * wire::big<std::int16_t>(data, 2 * i);
    return vector;
}

class XsensCan : public Decoder {
  public:
    explicit XsensCan(const XsensCanSettings& settings)
        : mounting_(settings), clock_(settings.sample_time_tick_us * 1e-6, 32) {}

    void decode(const Packet& packet, MeasurementSink& sink) override {
        const auto length = length_of(packet.can_id);
        if (!length) return;
        if (packet.data.size() != *length) return sink.refuse(Refusal::malformed);
        sink.frame(packet.data);
        if (packet.can_id == id::sample_time || packet.can_id == id::group_counter)
            begin(packet, sink);
        else
            take(packet, sink);
    }

    void reset() override {
        group_ = {};
        clock_.reset();
    }

  private:
    struct Group {
        std::optional<Timestamp> begun{};
        bool has_sample_time = false, has_counter = false;
        std::optional<Vec3> rate_radps{}, acceleration_mps2{};
        bool complete = false;

        bool has_values() const { return rate_radps || acceleration_mps2; }
    };

    Mounting mounting_;
    DeviceClock clock_;
    Group group_;

    void begin(const Packet& packet, MeasurementSink& sink) {
        const bool is_time = packet.can_id == id::sample_time;
        if (group_.has_values() || (is_time ? group_.has_sample_time : group_.has_counter)) end(sink);
        if (!group_.begun) group_.begun = packet.time;
        (is_time ? group_.has_sample_time : group_.has_counter) = true;
        if (is_time) group_.begun = clock_.host_time(wire::big<std::uint32_t>(packet.data, 0), packet.time);
    }

    /// One half alone is what was left of a sample.
    void end(MeasurementSink& sink) {
        if (group_.has_values() && !group_.complete) sink.refuse(Refusal::malformed);
        group_ = {};
    }

    void take(const Packet& packet, MeasurementSink& sink) {
        if (packet.can_id == id::pressure)
            return mounting_.give_pressure(group_.begun.value_or(packet.time), read_pressure(packet.data), sink);
        auto& half = packet.can_id == id::rate_of_turn ? group_.rate_radps : group_.acceleration_mps2;
        if (half) end(sink); // the beginning of the next group was lost
        if (!group_.begun) return sink.refuse(Refusal::malformed);
        half =
            read_steps(packet.data, packet.can_id == id::rate_of_turn ? xsens_rate_step_radps : xsens_force_step_mps2);
        if (!group_.rate_radps || !group_.acceleration_mps2) return;
        group_.complete = true;
        mounting_.give(*group_.begun, *group_.acceleration_mps2, *group_.rate_radps, sink);
    }

    /// The DBC calls it signed, but 2^31 steps would be 65 kPa, and there is more air than that.
    static double read_pressure(wire::Bytes data) { return xsens_pressure_step_pa * wire::big<std::uint32_t>(data, 0); }
};

CanFrame xsens_frame(id::Id can_id, std::uint64_t value, std::size_t length) {
    CanFrame frame{can_id, static_cast<std::uint8_t>(length), {}};
    for (std::size_t i = 0; i < length; ++i) frame.data[i] = static_cast<std::uint8_t>(value >> 8 * (length - 1 - i));
    return frame;
}

CanFrame xsens_vector_frame(id::Id can_id, const Vec3& values, double step) {
    std::uint64_t bits = 0;
    for (const double value : values) {
        const double steps = std::clamp(std::round(value / step), -32768.0, 32767.0);
        bits = bits << 16 | static_cast<std::uint16_t>(static_cast<std::int16_t>(steps));
    }
    return xsens_frame(can_id, bits, 6);
}

} // namespace

std::vector<CanFrame> encode(const XsensCanSample& sample) {
    std::vector<CanFrame> frames;
    if (sample.sample_time) frames.push_back(xsens_frame(id::sample_time, *sample.sample_time, 4));
    frames.push_back(xsens_frame(id::group_counter, sample.group_counter, 2));
    frames.push_back(xsens_vector_frame(id::rate_of_turn, sample.rate_radps, xsens_rate_step_radps));
    frames.push_back(xsens_vector_frame(id::acceleration, sample.acceleration_mps2, xsens_force_step_mps2));
    if (sample.pressure_pa) {
        const double steps = std::clamp(std::round(*sample.pressure_pa / xsens_pressure_step_pa), 0.0, 4294967295.0);
        frames.push_back(xsens_frame(id::pressure, static_cast<std::uint64_t>(steps), 4));
    }
    return frames;
}

std::unique_ptr<Decoder> make_xsens_can(const void* settings) {
    return std::make_unique<XsensCan>(*static_cast<const XsensCanSettings*>(settings));
}

} // namespace locus::imu
