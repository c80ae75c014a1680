// Bursts of an Epson M-G370 out of a stream, and their samples.
#include "drivers/imu/epson_g370.h"

#include "drivers/device_clock.h"
#include "drivers/frame_decoder.h"
#include "drivers/imu/epson_start.h"
#include "drivers/wire/checksum.h"
#include "fusion/units.h"

#include <charconv>

namespace locus::imu {
namespace {

constexpr double standard_mg_mps2 = standard_gravity_mps2 * 1e-3;

/// Both 0x80 and 0x0D occur within bursts: only with the checksum they mean anything.
struct EpsonFormat {
    static constexpr std::size_t max_length = longest_epson_burst;
    std::size_t length = max_length;

    Look look(wire::Bytes bytes) const {
        if (bytes[0] != 0x80) return Look::none(Refusal::garbage);
        if (bytes.size() < length) return Look::need(length);
        if (bytes[length - 1] != 0x0D) return Look::none(Refusal::garbage);
        const std::size_t sum_at = length - 3;
        if (wire::sum16_big(bytes.first(sum_at).subspan(1)) != wire::big<std::uint16_t>(bytes, sum_at))
            return Look::none(Refusal::bad_checksum);
        return Look::frame(length);
    }
};

/// Per step of the 16-bit field; the lower half of a 32-bit field are fractions of it.
struct EpsonScale {
    double rate_radps, force_mps2;
};

EpsonScale scale_of(const EpsonSettings& s) {
    const bool is_fast = s.model == "G370PDF1" || s.model == "G370PDG0";
    const bool has_ranges = s.model == "G370PDG0" || s.model == "G370PDT0";
    const double force_mg = !has_ranges ? 0.4 : s.accel_16g ? 0.5 : 0.25;
    const double part = s.wide ? 1.0 / 65536 : 1;
    return {(is_fast ? 0.0151515 : 0.0066667) * rad_per_deg * part, force_mg * standard_mg_mps2 * part};
}

double rate_of(const EpsonSettings& settings) {
    double rate_hz = 0; // one of the choices
    std::from_chars(settings.rate_hz.data(), settings.rate_hz.data() + settings.rate_hz.size(), rate_hz);
    return rate_hz;
}

Vec3 in_units(const std::array<std::int32_t, 3>& raw, double step) {
    return {raw[0] * step, raw[1] * step, raw[2] * step};
}

class EpsonG370 : public FrameDecoder<EpsonFormat> {
  public:
    explicit EpsonG370(const EpsonSettings& settings)
        : FrameDecoder(EpsonFormat{epson_burst_length(settings)}), settings_(settings), mounting_(settings),
          scale_(scale_of(settings)), clock_(1 / rate_of(settings), 16), start_(settings) {}

    void reset() override {
        FrameDecoder::reset();
        clock_.reset();
        start_.reset();
    }

    std::optional<Packet> request(Timestamp now) override {
        return settings_.configure ? start_.request(now) : std::nullopt;
    }

  private:
    EpsonSettings settings_;
    Mounting mounting_;
    EpsonScale scale_;
    DeviceClock clock_;
    EpsonStart start_;

    void frame(const Frame& frame, MeasurementSink& sink) override {
        sink.frame(frame.bytes);
        start_.heard_burst();
        const EpsonBurst burst = parse_epson_burst(frame.bytes, settings_);
        const Timestamp time = settings_.count ? clock_.host_time(burst.count, frame.begun) : frame.begun;
        mounting_.give(time, in_units(burst.accel, scale_.force_mps2), in_units(burst.gyro, scale_.rate_radps), sink);
    }
};

} // namespace

std::unique_ptr<Decoder> make_epson_g370(const void* settings) {
    return std::make_unique<EpsonG370>(*static_cast<const EpsonSettings*>(settings));
}

} // namespace locus::imu
