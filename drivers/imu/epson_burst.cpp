// Bursts of an Epson M-G370, read and written field by field in their one order.
#include "drivers/imu/epson_g370.h"
#include "drivers/wire/checksum.h"

namespace locus::imu {
namespace {

/// Takes field after field.
class EpsonReader {
  public:
    EpsonReader(wire::Bytes bytes, bool wide) : bytes_(bytes), wide_(wide) {}

    std::uint16_t word() { return static_cast<std::uint16_t>(take(2)); }
    std::int32_t number() {
        return static_cast<std::int32_t>(wire::sign_extended(take(wide_ ? 4 : 2), wide_ ? 32 : 16));
    }
    std::array<std::int32_t, 3> vector() {
        std::array<std::int32_t, 3> values{};
        for (std::int32_t& value : values) value = number();
        return values;
    }

  private:
    wire::Bytes bytes_;
    bool wide_;
    std::size_t at_ = 1; // behind the head

    std::uint64_t take(std::size_t size) {
        at_ += size;
        return wire::big_bytes(bytes_, at_ - size, size);
    }
};

void write_axes(wire::Writer& out, const std::array<std::int32_t, 3>& values, std::size_t size) {
    for (const std::int32_t value : values) out.big_bytes(static_cast<std::uint64_t>(std::int64_t{value}), size);
}

} // namespace

std::size_t epson_burst_length(const EpsonSettings& s) {
    const std::size_t size = s.wide ? 4 : 2;
    const std::size_t vectors = 2u + s.delta_angle + s.delta_velocity;
    return 1 + 2 * s.flag + size * s.temperature + 3 * size * vectors + 2 * s.gpio + 2 * s.count + 2 + 1;
}

EpsonBurst parse_epson_burst(wire::Bytes bytes, const EpsonSettings& settings) {
    EpsonReader reader{bytes, settings.wide};
    EpsonBurst burst;
    if (settings.flag) burst.flag = reader.word();
    if (settings.temperature) burst.temperature = reader.number();
    burst.gyro = reader.vector();
    burst.accel = reader.vector();
    if (settings.delta_angle) reader.vector();
    if (settings.delta_velocity) reader.vector();
    if (settings.gpio) burst.gpio = reader.word();
    if (settings.count) burst.count = reader.word();
    return burst;
}

std::vector<std::uint8_t> encode(const EpsonBurst& burst, const EpsonSettings& settings) {
    const std::size_t size = settings.wide ? 4 : 2;
    wire::Writer fields;
    if (settings.flag) fields.big(burst.flag);
    if (settings.temperature) fields.big_bytes(static_cast<std::uint64_t>(std::int64_t{burst.temperature}), size);
    write_axes(fields, burst.gyro, size);
    write_axes(fields, burst.accel, size);
    if (settings.delta_angle) fields.zeros(3 * size);
    if (settings.delta_velocity) fields.zeros(3 * size);
    if (settings.gpio) fields.big(burst.gpio);
    if (settings.count) fields.big(burst.count);
    const std::uint16_t sum = wire::sum16_big(fields.written());
    return wire::Writer{}.big(std::uint8_t{0x80}).bytes(fields.written()).big(sum).big(std::uint8_t{0x0D}).take();
}

} // namespace locus::imu
