// Where the bits of one signal lie in a frame, by the conventions of DBC files (protocols.md 6.5).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace locus::layout {

inline constexpr std::array<std::string_view, 2> byte_orders{"intel", "motorola"};
inline constexpr std::array<std::string_view, 4> value_types{"unsigned", "signed", "float", "double"};

struct BitField {
    unsigned start = 0;  ///< Intel: the lowest bit. Motorola: the highest; bits of byte 0 are 7..0, of byte 1 15..8
    unsigned length = 1; ///< 1 to 64
    bool motorola = false;

    /// Bytes that a frame must have.
    std::size_t bytes_needed() const;
    /// The raw bits; `data` holds at least bytes_needed().
    std::uint64_t read(std::span<const std::uint8_t> data) const;
    void write(std::span<std::uint8_t> data, std::uint64_t raw) const;

  private:
    /// Byte and bit of the signal's i-th bit, from its lowest.
    std::size_t bit_at(unsigned i) const;
};

/// What the raw bits say as a `type` of value_types; not finite where a float says so.
double value_of(std::uint64_t raw, unsigned length, std::string_view type);
/// The raw bits of the value, rounded and held to what they can say.
std::uint64_t raw_of(double value, unsigned length, std::string_view type);

} // namespace locus::layout
