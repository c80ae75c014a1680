// VectorNav messages and lines out of one stream, and their samples.
#include "drivers/imu/vectornav.h"

#include "drivers/device_clock.h"
#include "drivers/frame_decoder.h"
#include "drivers/wire/checksum.h"

#include <algorithm>

namespace locus::imu {
namespace {

constexpr std::string_view vnymr_head = "$VNYMR,";
constexpr std::size_t longest_vnymr = 160; // 121 as the device writes it
constexpr float microtesla_per_gauss = 100;

std::string_view text_of(wire::Bytes bytes) { return {reinterpret_cast<const char*>(bytes.data()), bytes.size()}; }

/// Without "\r\n".
std::string_view line_of(wire::Bytes bytes) {
    const std::string_view text = text_of(bytes);
    return text.substr(0, std::min(text.find_first_of("\r\n"), text.size()));
}

struct VectorNavFormat {
    static constexpr std::size_t max_length = longest_vectornav_message;

    Look look(wire::Bytes bytes) const {
        if (bytes[0] == vectornav_head) return look_at_message(bytes);
        if (bytes[0] == '$') return look_at_line(bytes);
        return Look::none(Refusal::garbage);
    }

  private:
    static Look look_at_message(wire::Bytes bytes) {
        const auto length = vectornav_length(bytes);
        if (!length) return Look::need(bytes.size() + 1);
        if (*length == 0) return Look::none(Refusal::garbage);
        if (bytes.size() < *length) return Look::need(*length);
        // Over its own checksum the checksum is zero.
        if (wire::crc16_xmodem(bytes.first(*length).subspan(1)) != 0) return Look::none(Refusal::bad_checksum);
        return Look::frame(*length);
    }

    static Look look_at_line(wire::Bytes bytes) {
        const std::string_view text = text_of(bytes.first(std::min(bytes.size(), longest_vnymr)));
        if (text.substr(0, vnymr_head.size()) != vnymr_head.substr(0, text.size())) return Look::none(Refusal::garbage);
        const std::size_t end = text.find('\n');
        if (end != std::string_view::npos)
            return parse_vnymr(line_of(bytes.first(end))) ? Look::frame(end + 1) : Look::none(Refusal::bad_checksum);
        return text.size() < longest_vnymr ? Look::need(text.size() + 1) : Look::none(Refusal::too_long);
    }
};

class VectorNav : public FrameDecoder<VectorNavFormat> {
  public:
    explicit VectorNav(const VectorNavSettings& settings) : mounting_(settings) {}

    void reset() override {
        FrameDecoder::reset();
        clock_.reset();
    }

  private:
    Mounting mounting_;
    DeviceClock clock_{1e-9, 64}; // TimeStartup

    void frame(const Frame& frame, MeasurementSink& sink) override {
        sink.frame(frame.bytes);
        const bool is_binary = frame.bytes[0] == vectornav_head;
        const VectorNavData data =
            is_binary ? parse_vectornav(frame.bytes) : parse_vnymr(line_of(frame.bytes)).value_or(VectorNavData{});
        const Timestamp time =
            data.time_startup_ns ? clock_.host_time(*data.time_startup_ns, frame.begun) : frame.begun;
        if (data.acceleration_mps2 && data.rate_radps)
            mounting_.give(time, *data.acceleration_mps2, *data.rate_radps, sink, field_ut(data));
        // A VN-100 without a barometer says 0.
        if (data.pressure_kpa && *data.pressure_kpa != 0) mounting_.give_pressure(time, *data.pressure_kpa * 1e3, sink);
    }

    static Vec3f field_ut(const VectorNavData& data) {
        if (!data.magnetic_gauss) return unknown_vec3f;
        const auto& [x, y, z] = *data.magnetic_gauss;
        return {microtesla_per_gauss * static_cast<float>(x), microtesla_per_gauss * static_cast<float>(y),
                microtesla_per_gauss * static_cast<float>(z)};
    }
};

} // namespace

std::unique_ptr<Decoder> make_vectornav(const void* settings) {
    return std::make_unique<VectorNav>(*static_cast<const VectorNavSettings*>(settings));
}

} // namespace locus::imu
