// Xbus messages out of a stream, and what of them are samples.
#include "drivers/imu/xsens.h"

#include "drivers/device_clock.h"
#include "drivers/frame_decoder.h"
#include "drivers/wire/checksum.h"

namespace locus::imu {
namespace {

constexpr std::size_t short_head = 4;    // preamble, bus, message, length
constexpr std::size_t extended_head = 6; // with two bytes more of length
constexpr std::size_t largest_data = 2048;

bool is_extended(wire::Bytes bytes) { return bytes[3] == xbus::extended_length; }

/// Of a whole message that is MTData2.
std::optional<XsensData> parse_message(wire::Bytes bytes) {
    const std::size_t head = is_extended(bytes) ? extended_head : short_head;
    return parse_mtdata2(bytes.subspan(head, bytes.size() - head - 1));
}

struct XbusFormat {
    static constexpr std::size_t max_length = extended_head + largest_data + 1;

    Look look(wire::Bytes bytes) const {
        if (bytes[0] != xbus::preamble || (bytes.size() > 1 && bytes[1] != xbus::bus_id))
            return Look::none(Refusal::garbage);
        if (bytes.size() < short_head) return Look::need(short_head);
        const std::size_t head = is_extended(bytes) ? extended_head : short_head;
        if (bytes.size() < head) return Look::need(head);
        const std::size_t data = is_extended(bytes) ? wire::big<std::uint16_t>(bytes, short_head) : bytes[3];
        if (data > largest_data) return Look::none(Refusal::too_long);
        const std::size_t length = head + data + 1;
        if (bytes.size() < length) return Look::need(length);
        if (wire::sum8(bytes.first(length).subspan(1)) != 0) return Look::none(Refusal::bad_checksum);
        // The sum is weak: a lost FA makes up for the next message's. Then that one must still be found.
        if (bytes[2] == xbus::mtdata2 && !parse_message(bytes.first(length))) return Look::none(Refusal::malformed);
        return Look::frame(length);
    }
};

class Xsens : public FrameDecoder<XbusFormat> {
  public:
    explicit Xsens(const XsensSettings& settings)
        : mounting_(settings), packet_rate_hz_(settings.packet_rate_hz),
          counter_(packet_rate_hz_ > 0 ? 1 / packet_rate_hz_ : 1, 16) {}

    void reset() override {
        FrameDecoder::reset();
        fine_.reset();
        counter_.reset();
    }

  private:
    Mounting mounting_;
    double packet_rate_hz_;
    DeviceClock fine_{1e-4, 32}; // SampleTimeFine
    DeviceClock counter_;

    /// Other messages are answers to somebody's commands.
    void frame(const Frame& frame, MeasurementSink& sink) override {
        sink.frame(frame.bytes);
        const auto data = frame.bytes[2] == xbus::mtdata2 ? parse_message(frame.bytes) : std::nullopt;
        if (!data) return;
        const Timestamp time = time_of(*data, frame.begun);
        if (data->acceleration_mps2 && data->rate_radps)
            mounting_.give(time, *data->acceleration_mps2, *data->rate_radps, sink);
        if (data->pressure_pa) mounting_.give_pressure(time, *data->pressure_pa, sink);
    }

    Timestamp time_of(const XsensData& data, Timestamp received) {
        if (data.sample_time_fine) return fine_.host_time(*data.sample_time_fine, received);
        if (data.packet_counter && packet_rate_hz_ > 0) return counter_.host_time(*data.packet_counter, received);
        return received;
    }
};

} // namespace

std::unique_ptr<Decoder> make_xsens(const void* settings) {
    return std::make_unique<Xsens>(*static_cast<const XsensSettings*>(settings));
}

} // namespace locus::imu
