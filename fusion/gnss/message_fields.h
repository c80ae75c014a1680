// What a navigation message holds is said once, in a walk over its fields: a FieldReader takes the values out of the
// bits, a FieldWriter puts them in, so that encoder and decoder cannot disagree.
#pragma once

#include "fusion/gnss/message_bits.h"

#include <cmath>
#include <initializer_list>
#include <ranges>
#include <span>
#include <type_traits>

namespace locus::gnss {

/// T is Message, const or not: one walk both reads and fills a struct.
template <class T, class Message>
concept ConstOrNot = std::is_same_v<std::remove_const_t<T>, Message>;

/// Bits of one of the message's parts (subframes, pages, words, strings; counted from 0). A field that is cut in pieces
/// has several, the highest bits first, 32 bits in all.
struct Place {
    std::size_t part, begin, length;
};
using Places = std::initializer_list<Place>;

/// Every scaled field is a whole number of steps of 2^power * unit, as the interface documents give scale factors.
class FieldReader {
  public:
    explicit FieldReader(std::span<const MessageBits> parts) : parts_{parts} {}

    template <class T>
    void number(T& field, Places places) const {
        field = static_cast<T>(raw(places).value);
    }
    void scaled(double& field, Places places, int power, double unit = 1) const {
        field = std::ldexp(static_cast<double>(raw(places).value), power) * unit;
    }
    /// Two's complement.
    void scaled_signed(double& field, Places places, int power, double unit = 1) const {
        const auto [value, sign] = raw(places);
        field = std::ldexp(static_cast<double>(static_cast<std::int32_t>((value ^ sign) - sign)), power) * unit;
    }
    /// The first bit is the sign of the others (GLONASS).
    void scaled_magnitude(double& field, Places places, int power, double unit = 1) const {
        const auto [value, sign] = raw(places);
        const double magnitude = std::ldexp(static_cast<double>(value & ~sign), power) * unit;
        field = value & sign ? -magnitude : magnitude;
    }

  private:
    std::span<const MessageBits> parts_;

    struct Raw {
        std::uint32_t value, sign;
    };
    Raw raw(Places places) const {
        std::uint32_t value = 0;
        std::size_t length = 0;
        for (const Place& place : places) {
            value = (place.length < 32 ? value << place.length : 0) | parts_[place.part].get(place.begin, place.length);
            length += place.length;
        }
        return {value, 1u << (length - 1)};
    }
};

/// Rounds to the nearest step. A value that has no room is not written, and fits() says so.
class FieldWriter {
  public:
    explicit FieldWriter(std::span<MessageBits> parts) : parts_{parts} {}

    bool fits() const { return fits_; }

    template <class T>
    void number(const T& field, Places places) {
        put(static_cast<double>(field), 0, full(places) - 1, places);
    }
    void scaled(double field, Places places, int power, double unit = 1) {
        put(steps(field, power, unit), 0, full(places) - 1, places);
    }
    void scaled_signed(double field, Places places, int power, double unit = 1) {
        put(steps(field, power, unit), -full(places) / 2, full(places) / 2 - 1, places);
    }
    void scaled_magnitude(double field, Places places, int power, double unit = 1) {
        const double half = full(places) / 2, count = steps(field, power, unit);
        if (!(std::abs(count) < half)) fits_ = false;
        put(count < 0 ? half - count : count, 0, full(places) - 1, places);
    }

  private:
    std::span<MessageBits> parts_;
    bool fits_ = true;

    static double steps(double field, int power, double unit) {
        return std::nearbyint(std::ldexp(field / unit, -power));
    }

    static double full(Places places) {
        std::size_t length = 0;
        for (const Place& place : places) length += place.length;
        return std::ldexp(1.0, static_cast<int>(length));
    }

    void put(double count, double least, double most, Places places) {
        if (!(count >= least && count <= most)) {
            fits_ = false;
            return;
        }
        auto value = static_cast<std::uint64_t>(static_cast<std::int64_t>(count));
        for (const Place& place : std::views::reverse(places)) {
            parts_[place.part].set(place.begin, place.length, static_cast<std::uint32_t>(value));
            value >>= place.length;
        }
    }
};

} // namespace locus::gnss
