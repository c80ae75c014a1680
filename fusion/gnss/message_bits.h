// The information bits of a navigation message in one row, parity left out, so that a field is a position and a length,
// also where the message cuts it in two.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace locus::gnss {

class MessageBits {
  public:
    static constexpr std::size_t capacity = 256;

    constexpr MessageBits() = default;
    /// `size` zeros, to be set field by field.
    explicit constexpr MessageBits(std::size_t size) : size_{size < capacity ? size : capacity} {}

    /// The lowest `count` (at most 32) bits of `value`, highest first; what has no room is dropped.
    constexpr void append(std::uint32_t value, std::size_t count) {
        for (std::size_t i = count; i-- > 0 && size_ < capacity; ++size_)
            bytes_[size_ / 8] = static_cast<std::uint8_t>(bytes_[size_ / 8] | (value >> i & 1) << (7 - size_ % 8));
    }

    constexpr std::size_t size() const { return size_; }

    /// The lowest `length` (at most 32) bits of `value`; those beyond the end are dropped.
    constexpr MessageBits& set(std::size_t begin, std::size_t length, std::uint32_t value) {
        for (std::size_t i = begin; i < begin + length && i < size_; ++i) {
            const unsigned place = 7 - i % 8, bit = value >> (begin + length - 1 - i) & 1;
            bytes_[i / 8] = static_cast<std::uint8_t>((bytes_[i / 8] & ~(1u << place)) | bit << place);
        }
        return *this;
    }

    /// `length` up to 32; bits that are not there read as 0.
    constexpr std::uint32_t get(std::size_t begin, std::size_t length) const {
        std::uint32_t value = 0;
        for (std::size_t i = begin; i < begin + length; ++i)
            value = value << 1 | (i < size_ ? bytes_[i / 8] >> (7 - i % 8) & 1u : 0u);
        return value;
    }

  private:
    std::array<std::uint8_t, capacity / 8> bytes_{};
    std::size_t size_ = 0;
};

} // namespace locus::gnss
