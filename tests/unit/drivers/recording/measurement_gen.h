// Random measurements of every kind for property tests; unknown values are left unknown half of the time.
#pragma once

#include "drivers/recording/measurement_fields.h"

#include <rapidcheck.h>

#include <bit>
#include <cmath>

namespace locus::test {

/// Any finite value of the type, from random bits: denormals and extremes too.
template <class Float>
Float any_finite() {
    using Bits = std::conditional_t<sizeof(Float) == 8, std::uint64_t, std::uint32_t>;
    const auto bits = *rc::gen::arbitrary<Bits>();
    const auto value = std::bit_cast<Float>(static_cast<Bits>(bits * 0x9E3779B97F4A7C15u));
    return std::isfinite(value) ? value : Float{0};
}

class RandomFields {
  public:
    template <class T>
    void must(std::string_view, T& value) {
        fill(value);
    }
    template <class T>
    void may(std::string_view, T& value) {
        if (*rc::gen::arbitrary<bool>()) fill(value);
    }
    void gone(std::string_view) {}

  private:
    template <class T>
    static void fill(T& value) {
        if constexpr (std::is_floating_point_v<T>)
            value = any_finite<T>();
        else
            value = *rc::gen::inRange<T>(0, std::numeric_limits<T>::max());
    }
    static void fill(Address& value) { value = address(*rc::gen::arbitrary<std::uint64_t>()); }
    static void fill(LineOfSight& value) { value = *rc::gen::element(LineOfSight::clear, LineOfSight::blocked); }
    template <class T, std::size_t Size>
    static void fill(std::array<T, Size>& values) {
        for (T& value : values) fill(value);
    }
};

template <std::size_t Kind = 0>
void emplace_kind(std::size_t kind, Observation& observation) {
    if constexpr (Kind < std::variant_size_v<Observation>) {
        if (kind == Kind)
            observation.emplace<Kind>();
        else
            emplace_kind<Kind + 1>(kind, observation);
    }
}

inline Measurement random_measurement() {
    constexpr std::int64_t limit_ns = 9'000'000'000'000'000'000;
    Measurement measurement;
    measurement.time = timestamp_from_ns(*rc::gen::inRange<std::int64_t>(-limit_ns + 1, limit_ns));
    measurement.sequence = *rc::gen::arbitrary<std::uint32_t>();
    measurement.input = *rc::gen::arbitrary<std::uint16_t>();
    emplace_kind(*rc::gen::inRange<std::size_t>(0, std::variant_size_v<Observation>), measurement.observation);
    RandomFields random;
    std::visit([&](auto& sample) { visit_fields(random, sample); }, measurement.observation);
    return measurement;
}

/// Compares to the bit, so that -0 differs from 0 and NaN equals itself.
class FieldBits {
  public:
    std::vector<std::uint64_t> bits;
    template <class T>
    void must(std::string_view, const T& value) {
        add(value);
    }
    template <class T>
    void may(std::string_view, const T& value) {
        add(value);
    }
    void gone(std::string_view) {}

  private:
    void add(float value) { bits.push_back(std::isnan(value) ? ~0u : std::bit_cast<std::uint32_t>(value)); }
    void add(double value) { bits.push_back(std::isnan(value) ? ~0ull : std::bit_cast<std::uint64_t>(value)); }
    template <class T>
        requires std::is_integral_v<T> || std::is_enum_v<T>
    void add(T value) {
        bits.push_back(static_cast<std::uint64_t>(value));
    }
    template <class T, std::size_t Size>
    void add(const std::array<T, Size>& values) {
        for (T value : values) add(value);
    }
};

inline bool same_bits(const Measurement& a, const Measurement& b) {
    if (a.time != b.time || a.sequence != b.sequence || a.input != b.input) return false;
    if (a.observation.index() != b.observation.index()) return false;
    FieldBits bits_a, bits_b;
    std::visit([&](const auto& sample) { visit_fields(bits_a, sample); }, a.observation);
    std::visit([&](const auto& sample) { visit_fields(bits_b, sample); }, b.observation);
    return bits_a.bits == bits_b.bits;
}

} // namespace locus::test
