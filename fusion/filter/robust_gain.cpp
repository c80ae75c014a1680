#include "fusion/filter/robust_gain.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace locus::filter {
namespace {

/// Innovations that the spread is estimated over: its own error is then about 5 %.
constexpr double memory = 500;
/// The stated noise is believed within a factor of two. Below, an exact device would make every move an outlier;
/// above, a filter in the wrong place would see none.
constexpr double least_spread = 0.5, most_spread = 2;

/// Means over a standard normal u of w, w u^2 and w^2 u^2.
struct Means {
    double w = 0, pull = 0, pull_squared = 0;
};

/// The trapezoid rule is exact to the last digits on a smooth curve that is nothing at both ends.
Means means(double scale) {
    constexpr double step = 0.01;
    Means sum;
    for (int i = -800; i <= 800; ++i) {
        const double u = step * i;
        const double density = step * std::exp(-0.5 * u * u) / std::sqrt(2 * std::numbers::pi);
        const double w = cauchy_weight(u, scale);
        sum.w += density * w;
        sum.pull += density * w * u * u;
        sum.pull_squared += density * w * w * u * u;
    }
    return sum;
}

} // namespace

// With u = innovation / sqrt(S) and the gain w K, the error after the update has the covariance
//   E[(e - w K nu)(e - w K nu)'] = P - (2 E[w u^2] - E[w^2 u^2]) K S K',
// for e has the mean K nu when nu is known. A filter that takes off w K S K' takes off E[w] on average, too much.
RobustGain::RobustGain(double scale) noexcept : scale_(scale) {
    const Means mean = means(scale);
    mean_pull_ = mean.pull;
    worth_ = std::min(1.0, (2 * mean.pull - mean.pull_squared) / mean.w);
}

// The spread is Huber's proposal 2 (Huber 1981, 6.4) one innovation at a time: where E[w u^2] is what it should be.
Share RobustGain::weigh(double innovation_in_sigma) noexcept {
    const double u = innovation_in_sigma / spread_;
    const double weight = cauchy_weight(u, scale_);
    const double too_wide = weight * u * u / mean_pull_ - 1;
    spread_ = std::clamp(spread_ * std::sqrt(1 + too_wide / memory), least_spread, most_spread);
    return {weight, worth_ * weight};
}

} // namespace locus::filter
