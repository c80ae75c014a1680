// Who goes with whom, at the least total cost: tracks with detections, and people with tags (paper 000 eq. 28).
// Rectangular, for it is normal that some have no partner.
#pragma once

#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace locus::vision {

/// A table of costs, none yet: every pair is forbidden until it is given a finite cost.
class Costs {
  public:
    Costs(std::size_t rows, std::size_t columns)
        : rows_(rows), columns_(columns), costs_(rows * columns, std::numeric_limits<double>::infinity()) {}

    std::size_t rows() const { return rows_; }
    std::size_t columns() const { return columns_; }
    double& at(std::size_t row, std::size_t column) { return costs_[row * columns_ + column]; }
    double at(std::size_t row, std::size_t column) const { return costs_[row * columns_ + column]; }

  private:
    std::size_t rows_;
    std::size_t columns_;
    std::vector<double> costs_;
};

using Pairing = std::vector<std::pair<std::size_t, std::size_t>>; ///< row, column; rows in rising order

/// The pairs whose sum of (limit - cost) is largest: to stay alone costs `limit`, so no pair at or above it is made,
/// nor one whose cost is no number. Costs may be negative but not below -limit; limit > 0. Kuhn's method by dlib on
/// whole numbers: a millionth of the limit is the finest difference seen.
Pairing assign(const Costs& costs, double limit);

} // namespace locus::vision
