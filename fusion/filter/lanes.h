// Arithmetic that compilers turn into vector instructions: straight lines of float operations on lanes side by side, no
// branches and no calls. Results are the same bits on every machine that follows IEEE 754 (no fused operations).
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <numbers>

namespace locus::filter {

/// exp(x) for x <= 0, relative error below 3e-6; x below -80 counts as -80. Powers of two by the exponent bits, the
/// rest by the Taylor polynomial of degree six on +-0.35.
inline float exp_of_negative(float x) {
    const float bounded = x < -80.0f ? -80.0f : x;
    const float scaled = bounded * std::numbers::log2e_v<float>;
    const auto whole = static_cast<std::int32_t>(scaled - 0.5f); // towards zero: nearest, for all that is below zero
    const float rest = (scaled - static_cast<float>(whole)) * std::numbers::ln2_v<float>;
    const float even = 1.0f + rest * rest * (0.5f + rest * rest * (1.0f / 24 + rest * rest * (1.0f / 720)));
    const float odd = rest * (1.0f + rest * rest * (1.0f / 6 + rest * rest * (1.0f / 120)));
    return (even + odd) * std::bit_cast<float>((whole + 127) << 23);
}

/// Random numbers for lanes: eight independent xorshift generators (Marsaglia 2003, 13-17-5) side by side. Plain state:
/// copied with the filter, so that the same filter draws the same numbers.
class LaneRandom {
  public:
    static constexpr std::size_t width = 8;
    using Lanes = std::array<float, width>;

    explicit LaneRandom(std::uint64_t seed) noexcept {
        for (auto& state : states_) { // splitmix64 (Steele, Lea, Flood 2014) spreads the seed
            seed += 0x9e3779b97f4a7c15u;
            std::uint64_t z = (seed ^ (seed >> 30)) * 0xbf58476d1ce4e5b9u;
            z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
            state = static_cast<std::uint32_t>(z >> 32) | 1u;
        }
    }

    /// Uniform on 0..1.
    float uniform() noexcept {
        advance();
        return static_cast<float>(states_[0] >> 8) * 0x1p-24f;
    }

    /// Each lane the sum of four uniform numbers with mean 0 and variance 1: a bell without tails beyond 3.5. As noise
    /// that moves particles its first two moments are what counts.
    Lanes bell() noexcept {
        constexpr float half = 0x1p-16f;
        Lanes sum{};
        for (int pair = 0; pair < 2; ++pair) {
            advance();
            for (std::size_t i = 0; i < width; ++i)
                sum[i] += static_cast<float>(static_cast<std::int32_t>(states_[i] & 0xffffu)) * half +
                          static_cast<float>(static_cast<std::int32_t>(states_[i] >> 16)) * half;
        }
        for (float& each : sum) each = (each - 2.0f) * std::numbers::sqrt3_v<float>;
        return sum;
    }

  private:
    void advance() noexcept {
        for (auto& state : states_) {
            state ^= state << 13;
            state ^= state >> 17;
            state ^= state << 5;
        }
    }

    std::array<std::uint32_t, width> states_{};
};

} // namespace locus::filter
