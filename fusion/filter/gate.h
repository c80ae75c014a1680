// The gate: refuses an innovation that chance would hardly bring, yet never shuts a source out for good. When a filter
// is wrong and sure of it, every source looks wrong; a gate that stays shut then would never let it see the truth.
#pragma once

#include <cstdint>

namespace locus::filter {

/// Largest |innovation| in standard deviations that passes when a good observation may be refused with probability
/// `false_alarm` (chi-square of one degree of freedom). Throws std::domain_error outside 0..1; for construction only.
double gate_in_sigma(double false_alarm);

/// One source's memory of the gate: after `patience` refusals in a row one observation is let through, then it counts
/// anew. What is let through still carries its robust weight, so a source that is really wrong does little harm.
class Gate {
  public:
    bool passes(double innovation_in_sigma, double limit_in_sigma, std::uint32_t patience) noexcept;
    std::uint32_t refused_in_a_row() const noexcept { return refused_; }
    /// Since it refused one, none has passed but by patience.
    bool is_in_doubt() const noexcept { return in_doubt_; }

  private:
    std::uint32_t refused_ = 0;
    bool in_doubt_ = false;
};

} // namespace locus::filter
