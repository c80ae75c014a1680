// How much an observation that lies far from its prediction may still do. A hard gate alone loses tracks in multipath
// (it refuses the truth once the filter is wrong); a soft weight lets go slowly. Two things keep the weight honest:
// - far is measured in what innovations come to here. The filter's own figure for them has room for errors that stay
//   and for sites worse than this one, so that recorded innovations were 0.2 to 0.6 of it; a weight that went by it
//   alone would call an outlier good.
// - the covariance gives credit for what the weighted step is worth, not for the weight.
#pragma once

namespace locus::filter {

/// Weight 0..1 of a residual given in standard deviations, for the Cauchy distribution of scale `scale`: what lies
/// far out counts next to nothing (Zhang 1997, "Parameter estimation techniques", table 1).
inline double cauchy_weight(double residual_in_sigma, double scale) {
    const double u = residual_in_sigma / scale;
    return 1 / (1 + u * u);
}

/// The parts of a Kalman update that are done.
struct Share {
    double step = 1;   ///< 0..1 of the gain
    double credit = 1; ///< 0..1 of the covariance's reduction
};

class RobustGain {
  public:
    /// `scale` > 0: at how many standard deviations of the innovations, as they come, half the weight is left.
    explicit RobustGain(double scale) noexcept;

    /// Takes an innovation in units of the standard deviation that the filter expects of it, and learns from it.
    Share weigh(double innovation_in_sigma) noexcept;

    /// Standard deviation of the innovations as they come over the one that the filter expects, robustly estimated.
    double spread() const noexcept { return spread_; }

  private:
    double scale_;
    double mean_pull_ = 1; ///< E[w u^2] of a standard normal u: what says that the spread is right
    double worth_ = 1;     ///< credit over weight
    double spread_ = 1;
};

} // namespace locus::filter
