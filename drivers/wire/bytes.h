// Numbers in the bytes of a frame, little- or big-endian, read and written. Reading past the end gives zero: a decoder
// checks lengths first, and a mistake there must not become a read of foreign memory.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace locus::wire {

using Bytes = std::span<const std::uint8_t>;

/// The characters as bytes.
inline Bytes bytes_of(std::string_view text) {
    return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

namespace detail {
template <std::size_t size>
using Unsigned = std::conditional_t<
    size == 1, std::uint8_t,
    std::conditional_t<size == 2, std::uint16_t, std::conditional_t<size == 4, std::uint32_t, std::uint64_t>>>;

/// `count` bytes from `offset`, lowest first in the order that `index` gives.
template <class Index>
constexpr std::uint64_t gather(Bytes bytes, std::size_t offset, std::size_t count, Index index) {
    if (offset > bytes.size() || count > bytes.size() - offset) return 0;
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i) value |= std::uint64_t{bytes[offset + index(i)]} << (8 * i);
    return value;
}
} // namespace detail

/// `count` (1 to 8) bytes as an unsigned number.
constexpr std::uint64_t little_bytes(Bytes bytes, std::size_t offset, std::size_t count) {
    return detail::gather(bytes, offset, count, [](std::size_t i) { return i; });
}
constexpr std::uint64_t big_bytes(Bytes bytes, std::size_t offset, std::size_t count) {
    return detail::gather(bytes, offset, count, [count](std::size_t i) { return count - 1 - i; });
}

/// The lowest `bits` (1 to 64) of a two's complement number.
constexpr std::int64_t sign_extended(std::uint64_t value, unsigned bits) {
    const std::uint64_t sign = std::uint64_t{1} << (bits - 1);
    const std::uint64_t mask = sign | (sign - 1);
    return static_cast<std::int64_t>(((value & mask) ^ sign) - sign);
}

/// An integer, float or double at `offset`.
template <class T>
    requires std::is_arithmetic_v<T>
constexpr T little(Bytes bytes, std::size_t offset) {
    return std::bit_cast<T>(static_cast<detail::Unsigned<sizeof(T)>>(little_bytes(bytes, offset, sizeof(T))));
}
template <class T>
    requires std::is_arithmetic_v<T>
constexpr T big(Bytes bytes, std::size_t offset) {
    return std::bit_cast<T>(static_cast<detail::Unsigned<sizeof(T)>>(big_bytes(bytes, offset, sizeof(T))));
}

/// What encoders write into. Values go out in the order of the calls.
class Writer {
  public:
    Writer& bytes(Bytes more) {
        out_.insert(out_.end(), more.begin(), more.end());
        return *this;
    }
    Writer& little_bytes(std::uint64_t value, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) out_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
        return *this;
    }
    Writer& big_bytes(std::uint64_t value, std::size_t count) {
        for (std::size_t i = count; i-- > 0;) out_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
        return *this;
    }
    template <class T>
        requires std::is_arithmetic_v<T>
    Writer& little(T value) {
        return little_bytes(std::bit_cast<detail::Unsigned<sizeof(T)>>(value), sizeof(T));
    }
    template <class T>
        requires std::is_arithmetic_v<T>
    Writer& big(T value) {
        return big_bytes(std::bit_cast<detail::Unsigned<sizeof(T)>>(value), sizeof(T));
    }
    Writer& zeros(std::size_t count) {
        out_.resize(out_.size() + count);
        return *this;
    }

    Bytes written() const { return out_; }
    std::vector<std::uint8_t> take() { return std::move(out_); }

  private:
    std::vector<std::uint8_t> out_;
};

} // namespace locus::wire
