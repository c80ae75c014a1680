// What a decoder made of what it was given, in numbers.
#pragma once

#include "drivers/decoder.h"

#include <array>
#include <cstdint>
#include <numeric>
#include <variant>

namespace locus::sniff {

struct Tally {
    std::uint64_t frames = 0;
    std::uint64_t frame_bytes = 0;                                              ///< of frames that were understood
    std::array<std::uint64_t, std::variant_size_v<Observation>> measurements{}; ///< by kind, as observation_names
    std::array<std::uint64_t, refusal_count> refused{};                         ///< index: Refusal

    std::uint64_t all_measurements() const {
        return std::accumulate(measurements.begin(), measurements.end(), std::uint64_t{0});
    }
    std::uint64_t all_refused() const { return std::accumulate(refused.begin(), refused.end(), std::uint64_t{0}); }
};

class TallySink : public MeasurementSink {
  public:
    void accept(Timestamp /*time*/, const Observation& observation) override {
        ++tally.measurements[observation.index()];
    }
    void frame(std::span<const std::uint8_t> bytes) override {
        ++tally.frames;
        tally.frame_bytes += bytes.size();
    }
    void refuse(Refusal reason) override { ++tally.refused[static_cast<std::size_t>(reason)]; }

    Tally tally;
};

} // namespace locus::sniff
