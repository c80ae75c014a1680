// MTData2: its values read and written, in the four number formats.
#include "drivers/imu/xsens.h"
#include "drivers/wire/checksum.h"

#include <cmath>

namespace locus::imu {
namespace {

using xbus::Number;

constexpr std::size_t value_head = 3; // kind and length

constexpr std::size_t xbus_number_size(Number number) {
    constexpr std::array<std::size_t, 4> sizes{4, 4, 6, 8};
    return sizes[static_cast<std::size_t>(number)];
}

/// FP16.32 goes as its 32 bits of fraction, then its 16 bits of integer.
double read_xbus_number(wire::Bytes bytes, std::size_t at, Number number) {
    switch (number) {
    case Number::float32:
        return static_cast<double>(wire::big<float>(bytes, at));
    case Number::fp12_20:
        return std::ldexp(static_cast<double>(wire::big<std::int32_t>(bytes, at)), -20);
    case Number::fp16_32:
        return std::ldexp(static_cast<double>(wire::big<std::uint32_t>(bytes, at)), -32) +
               wire::big<std::int16_t>(bytes, at + 4);
    case Number::float64:
        break;
    }
    return wire::big<double>(bytes, at);
}

void write_xbus_number(wire::Writer& out, double value, Number number) {
    const auto fixed = [&](int bits) { return static_cast<std::uint64_t>(std::llround(std::ldexp(value, bits))); };
    switch (number) {
    case Number::float32:
        out.big(static_cast<float>(value));
        return;
    case Number::fp12_20:
        out.big_bytes(fixed(20), 4);
        return;
    case Number::fp16_32:
        out.big_bytes(fixed(32), 4).big_bytes(fixed(32) >> 32, 2);
        return;
    case Number::float64:
        out.big(value);
    }
}

/// False when the length is not what its format takes.
bool read_vector(wire::Bytes value, Number number, std::optional<Vec3>& into) {
    const std::size_t size = xbus_number_size(number);
    if (value.size() != 3 * size) return false;
    Vec3& vector = into.emplace();
    for (std::size_t i = 0; i < 3; ++i) vector[i] = read_xbus_number(value, i * size, number);
    return true;
}

template <class T>
bool read_integer(wire::Bytes value, std::optional<T>& into) {
    if (value.size() != sizeof(T)) return false;
    into = wire::big<T>(value, 0);
    return true;
}

/// What is sent both ways is taken at the rate of the message, not at high rate.
bool read_high_rate(wire::Bytes value, Number number, std::optional<Vec3>& into) {
    std::optional<Vec3> unused;
    return read_vector(value, number, into ? unused : into);
}

/// Kinds that we do not take are fine whatever they hold.
bool read_value(std::uint16_t kind_and_format, wire::Bytes value, XsensData& data) {
    const auto number = static_cast<Number>(kind_and_format & 3);
    switch (kind_and_format & xbus::kind_mask) {
    case xbus::packet_counter:
        return read_integer(value, data.packet_counter);
    case xbus::sample_time_fine:
        return read_integer(value, data.sample_time_fine);
    case xbus::pressure:
        return read_integer(value, data.pressure_pa);
    case xbus::acceleration:
        return read_vector(value, number, data.acceleration_mps2);
    case xbus::rate_of_turn:
        return read_vector(value, number, data.rate_radps);
    case xbus::acceleration_high_rate:
        return read_high_rate(value, number, data.acceleration_mps2);
    case xbus::rate_of_turn_high_rate:
        return read_high_rate(value, number, data.rate_radps);
    default:
        return true;
    }
}

template <class T>
void write_integer(wire::Writer& out, std::uint16_t kind, const std::optional<T>& value) {
    if (value) out.big(kind).big(static_cast<std::uint8_t>(sizeof(T))).big(*value);
}

void write_vector(wire::Writer& out, std::uint16_t kind, Number number, const std::optional<Vec3>& vector) {
    if (!vector) return;
    out.big(static_cast<std::uint16_t>(kind | static_cast<unsigned>(number)));
    out.big(static_cast<std::uint8_t>(3 * xbus_number_size(number)));
    for (const double value : *vector) write_xbus_number(out, value, number);
}

} // namespace

std::optional<XsensData> parse_mtdata2(wire::Bytes data) {
    XsensData result;
    while (!data.empty()) {
        if (data.size() < value_head || data.size() - value_head < data[2]) return std::nullopt;
        const auto kind = wire::big<std::uint16_t>(data, 0);
        if (!read_value(kind, data.subspan(value_head, data[2]), result)) return std::nullopt;
        data = data.subspan(value_head + data[2]);
    }
    return result;
}

std::vector<std::uint8_t> encode(const XsensData& data, xbus::Number number) {
    wire::Writer values;
    write_integer(values, xbus::packet_counter, data.packet_counter);
    write_integer(values, xbus::sample_time_fine, data.sample_time_fine);
    write_integer(values, xbus::pressure, data.pressure_pa);
    write_vector(values, xbus::acceleration, number, data.acceleration_mps2);
    write_vector(values, xbus::rate_of_turn, number, data.rate_radps);
    wire::Writer body; // never longer than 98 bytes: the short length will do
    body.big(xbus::bus_id).big(xbus::mtdata2).big(static_cast<std::uint8_t>(values.written().size()));
    body.bytes(values.written());
    const auto checksum = static_cast<std::uint8_t>(-wire::sum8(body.written()));
    return wire::Writer{}.big(xbus::preamble).bytes(body.written()).big(checksum).take();
}

} // namespace locus::imu
