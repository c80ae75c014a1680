// Innovation-based adaptive estimation (IAE): how large the noise of a kind of observation really is, from what the
// innovations come to (Mohamed and Schwarz 1999, "Adaptive Kalman filtering for INS/GPS", eq. 11: R = C_v - H P H').
// One factor on the stated variance, learnt slowly and within bounds, so that one bad stretch does not make the filter
// deaf for the next.
#pragma once

#include <algorithm>

namespace locus::filter {

class AdaptiveNoise {
  public:
    /// What the stated variance is to be multiplied with.
    double factor() const noexcept { return factor_; }

    /// `state_variance`: h' P h; `variance`: as stated, not multiplied.
    void learn(double innovation, double state_variance, double variance) noexcept {
        const double seen =
            (std::min(innovation * innovation, clip * (state_variance + factor_ * variance)) - state_variance) /
            variance;
        factor_ = std::clamp(factor_ + (seen - factor_) / memory, least, most);
    }

  private:
    static constexpr double memory = 200;            ///< innovations: the factor's own error is then a tenth
    static constexpr double clip = 9;                ///< one innovation counts for no more than three sigma
    static constexpr double least = 0.1, most = 100; ///< the stated sigma is believed within 0.3 and 10 times

    double factor_ = 1;
};

} // namespace locus::filter
