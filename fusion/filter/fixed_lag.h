// A second opinion on where a target was a moment ago, for those who can wait: the state of each tick goes into a
// window, and what came after it goes back through the window (Rauch, Tung, Striebel 1965; Sarkka 2013, section 8.2).
// It works on what estimators publish, position and velocity, so every estimator has it. What came late stands in the
// window where it came in, not where it belongs: the window never is more sure than that.
#pragma once

#include "fusion/pose.h"

#include <Eigen/Core>
#include <boost/circular_buffer.hpp>

#include <optional>

namespace locus::filter {

class FixedLag {
  public:
    /// Looks `ticks` >= 1 back.
    explicit FixedLag(std::size_t ticks) : nodes_(ticks + 1) {}

    /// `filtered` is the state at a tick, `foreseen` what the state before had said of it. A jump empties the window.
    void add(const Estimate& filtered, const Estimate& foreseen) noexcept;

    /// The state of as many ticks ago as the window is long; none while it is not that long yet.
    std::optional<Estimate> smoothed() const noexcept;

  private:
    using Vector6 = Eigen::Matrix<double, 6, 1>;
    using Matrix6 = Eigen::Matrix<double, 6, 6>;

    struct Node {
        Estimate filtered;
        Vector6 foreseen = Vector6::Zero(); ///< of this tick, by the node before
        Matrix6 foreseen_covariance = Matrix6::Zero();
        Matrix6 gain = Matrix6::Zero(); ///< from this tick back to the node before
    };

    boost::circular_buffer<Node> nodes_;
};

} // namespace locus::filter
