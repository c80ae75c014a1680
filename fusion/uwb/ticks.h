// Stamps of a DW1000: a free-running counter of 40 bits, of which some devices tell only the low 32, in steps of
// 15.65 ps (protocols.md section 1). What is here is exact: stamps are whole numbers and stay so over every wrap.
#pragma once

#include <cstdint>

namespace locus::uwb {

inline constexpr double speed_of_light_mps = 299792458;
inline constexpr double tick_s = 1 / (128 * 499.2e6);
inline constexpr double tick_m = tick_s * speed_of_light_mps; ///< 4.69 mm
inline constexpr int dw1000_clock_bits = 40;                  ///< wraps after 17.2 s; 32 bits after 67 ms

/// Arithmetic on a counter of 2 to 60 bits. Whatever stands above those bits in a stamp is left out.
class WrappingClock {
  public:
    constexpr explicit WrappingClock(int bits = dw1000_clock_bits) : period_(std::int64_t{1} << bits) {}

    constexpr std::int64_t period_ticks() const { return period_; }

    /// From `earlier` to `later` with time running forwards: 0 to period - 1.
    constexpr std::int64_t since(std::uint64_t later, std::uint64_t earlier) const {
        return static_cast<std::int64_t>((later - earlier) & mask());
    }

    /// The shorter way round: -period/2 to period/2 - 1.
    constexpr std::int64_t between(std::uint64_t later, std::uint64_t earlier) const {
        const std::int64_t forward = since(later, earlier);
        return forward < period_ / 2 ? forward : forward - period_;
    }

    /// Of all the intervals that the two stamps may have between them, the one nearest to what is expected; so one
    /// that is longer than the counter can be told. |expected| < 2^62.
    constexpr std::int64_t between_near(std::uint64_t later, std::uint64_t earlier, std::int64_t expected_ticks) const {
        return expected_ticks + between(later - static_cast<std::uint64_t>(expected_ticks), earlier);
    }

  private:
    std::int64_t period_;

    constexpr std::uint64_t mask() const { return static_cast<std::uint64_t>(period_) - 1; }
};

} // namespace locus::uwb
