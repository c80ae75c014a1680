// Who goes with whom, at the least total cost: tracks with detections, and people with tags (paper 000 eq. 28).
// Rectangular, for it is normal that some have no partner.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace locus::vision {

/// A table of costs, none yet: every pair is forbidden until it is given a finite cost.
class Costs {
  public:
    Costs(std::size_t rows, std::size_t columns) { reset(rows, columns); }

    /// Begins anew; allocates only where it was never that large.
    void reset(std::size_t rows, std::size_t columns) {
        rows_ = rows;
        columns_ = columns;
        costs_.assign(rows * columns, std::numeric_limits<double>::infinity());
    }

    std::size_t rows() const { return rows_; }
    std::size_t columns() const { return columns_; }
    double& at(std::size_t row, std::size_t column) { return costs_[row * columns_ + column]; }
    double at(std::size_t row, std::size_t column) const { return costs_[row * columns_ + column]; }

  private:
    std::size_t rows_ = 0;
    std::size_t columns_ = 0;
    std::vector<double> costs_;
};

using Pair = std::pair<std::size_t, std::size_t>; ///< row, column
using Pairing = std::vector<Pair>;

/// Kuhn's method with shortest augmenting paths (Jonker and Volgenant 1987), on memory that is set aside once: dlib's
/// max_cost_assignment, its oracle in the tests, wants a square of whole numbers and allocates. Each row that is added
/// looks for the cheapest way to a column of its own, along which others move to their next best.
class Assigner {
  public:
    /// For tables up to this size. Copies allocate.
    Assigner(std::size_t rows, std::size_t columns);

    /// The pairs whose sum of (limit - cost) is largest, rows in rising order: to stay alone costs `limit`, so no pair
    /// at or above it is made, nor one whose cost is no number. Costs below -limit count as -limit; limit > 0.
    /// Allocates only for a table larger than foreseen. Valid until the next call.
    std::span<const Pair> assign(const Costs& costs, double limit);

  private:
    struct Column {
        double price = 0;
        double reach = 0;        ///< length of the shortest way to it that is known
        std::size_t row = 0;     ///< whose it is
        std::size_t before = 0;  ///< on that way
        bool is_settled = false; ///< no shorter way will come
    };

    void begin(std::size_t rows, std::size_t columns);
    double cost(const Costs& costs, std::size_t row, std::size_t column) const noexcept;
    void add(const Costs& costs, std::size_t row);
    std::size_t nearest_open() const noexcept;
    void reach_from(const Costs& costs, std::size_t column) noexcept;
    void pay(double length) noexcept;

    double limit_ = 0;
    std::vector<Column> columns_;    ///< the table's, one for each row that stays alone, and a last one to start from
    std::vector<double> row_prices_; ///< beside the table's rows
    Pairing pairs_;
};

/// The same once.
Pairing assign(const Costs& costs, double limit);

} // namespace locus::vision
