#include "drivers/layout/dbc_signal.h"

#include "drivers/wire/bytes.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace locus::layout {
namespace {

/// "Sawtooth" numbering to a row of bits with the highest bit of byte 0 first (protocols.md 6.5), and back.
constexpr unsigned in_row(unsigned sawtooth) { return 8 * (sawtooth / 8) + 7 - sawtooth % 8; }

} // namespace

std::size_t BitField::bit_at(unsigned i) const { return motorola ? in_row(in_row(start) + length - 1 - i) : start + i; }

std::size_t BitField::bytes_needed() const { return std::max(bit_at(0), bit_at(length - 1)) / 8 + 1; }

std::uint64_t BitField::read(std::span<const std::uint8_t> data) const {
    std::uint64_t raw = 0;
    for (unsigned i = 0; i < length; ++i) {
        const std::size_t bit = bit_at(i);
        raw |= std::uint64_t{data[bit / 8] >> (bit % 8) & 1u} << i;
    }
    return raw;
}

void BitField::write(std::span<std::uint8_t> data, std::uint64_t raw) const {
    for (unsigned i = 0; i < length; ++i) {
        const std::size_t bit = bit_at(i);
        const auto mask = static_cast<std::uint8_t>(1u << (bit % 8));
        data[bit / 8] = static_cast<std::uint8_t>(raw >> i & 1 ? data[bit / 8] | mask : data[bit / 8] & ~mask);
    }
}

double value_of(std::uint64_t raw, unsigned length, std::string_view type) {
    if (type == "float") return std::bit_cast<float>(static_cast<std::uint32_t>(raw));
    if (type == "double") return std::bit_cast<double>(raw);
    if (type == "signed") return static_cast<double>(wire::sign_extended(raw, length));
    return static_cast<double>(raw);
}

std::uint64_t raw_of(double value, unsigned length, std::string_view type) {
    if (type == "float") return std::bit_cast<std::uint32_t>(static_cast<float>(value));
    if (type == "double") return std::bit_cast<std::uint64_t>(value);
    const bool is_signed = type == "signed";
    const double steps = std::ldexp(1.0, static_cast<int>(length) - is_signed);
    const double held = std::clamp(std::round(value), is_signed ? -steps : 0.0, std::nextafter(steps, 0.0));
    const auto bits = is_signed ? static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(held)))
                                : static_cast<std::uint64_t>(std::floor(held));
    return length == 64 ? bits : bits & ((std::uint64_t{1} << length) - 1);
}

} // namespace locus::layout
