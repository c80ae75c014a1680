// The information bits of a navigation message in one row, parity left out, so that a field is a position and a length,
// also where the message cuts it in two.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace locus::gnss {

class MessageBits {
  public:
    static constexpr std::size_t capacity = 256;

    /// The lowest `count` (at most 32) bits of `value`, highest first; what has no room is dropped.
    constexpr void append(std::uint32_t value, std::size_t count) {
        for (std::size_t i = count; i-- > 0 && size_ < capacity; ++size_)
            bytes_[size_ / 8] = static_cast<std::uint8_t>(bytes_[size_ / 8] | (value >> i & 1) << (7 - size_ % 8));
    }

    constexpr std::size_t size() const { return size_; }

    /// `length` up to 32; bits that are not there read as 0.
    constexpr std::uint32_t get(std::size_t begin, std::size_t length) const {
        std::uint32_t value = 0;
        for (std::size_t i = begin; i < begin + length; ++i)
            value = value << 1 | (i < size_ ? bytes_[i / 8] >> (7 - i % 8) & 1u : 0u);
        return value;
    }

    /// Two's complement.
    constexpr std::int32_t get_signed(std::size_t begin, std::size_t length) const {
        const std::uint32_t sign = 1u << (length - 1);
        return static_cast<std::int32_t>((get(begin, length) ^ sign) - sign);
    }

    /// The first bit is the sign of the others (GLONASS).
    constexpr std::int32_t get_magnitude(std::size_t begin, std::size_t length) const {
        const auto magnitude = static_cast<std::int32_t>(get(begin + 1, length - 1));
        return get(begin, 1) ? -magnitude : magnitude;
    }

    /// Times 2^power, as the interface documents give scale factors.
    double scaled(std::size_t begin, std::size_t length, int power) const {
        return std::ldexp(static_cast<double>(get(begin, length)), power);
    }
    double scaled_signed(std::size_t begin, std::size_t length, int power) const {
        return std::ldexp(static_cast<double>(get_signed(begin, length)), power);
    }
    double scaled_magnitude(std::size_t begin, std::size_t length, int power) const {
        return std::ldexp(static_cast<double>(get_magnitude(begin, length)), power);
    }

  private:
    std::array<std::uint8_t, capacity / 8> bytes_{};
    std::size_t size_ = 0;
};

} // namespace locus::gnss
