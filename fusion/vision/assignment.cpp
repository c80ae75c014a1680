#include "fusion/vision/assignment.h"

#include <algorithm>

namespace locus::vision {
namespace {

constexpr std::size_t nobody = static_cast<std::size_t>(-1);
constexpr double far = std::numeric_limits<double>::infinity();

} // namespace

Assigner::Assigner(std::size_t rows, std::size_t columns) {
    columns_.reserve(rows + columns + 1);
    row_prices_.reserve(rows);
    pairs_.reserve(std::min(rows, columns));
}

std::span<const Pair> Assigner::assign(const Costs& costs, double limit) {
    limit_ = limit;
    begin(costs.rows(), costs.columns());
    for (std::size_t row = 0; row < costs.rows(); ++row) add(costs, row);
    for (std::size_t column = 0; column < costs.columns(); ++column)
        if (columns_[column].row != nobody) pairs_.emplace_back(columns_[column].row, column);
    std::sort(pairs_.begin(), pairs_.end());
    return pairs_;
}

void Assigner::begin(std::size_t rows, std::size_t columns) {
    columns_.assign(columns + rows + 1, Column{.row = nobody});
    row_prices_.assign(rows, 0);
    pairs_.clear();
}

/// The columns behind the table's are places to stay alone, one for each row.
double Assigner::cost(const Costs& costs, std::size_t row, std::size_t column) const noexcept {
    if (column >= costs.columns()) return column - costs.columns() == row ? limit_ : far;
    const double cost = costs.at(row, column);
    return cost < limit_ ? std::max(cost, -limit_) : far;
}

/// Dijkstra's search on costs less prices, which are never negative.
void Assigner::add(const Costs& costs, std::size_t row) {
    const std::size_t start = columns_.size() - 1;
    for (Column& column : columns_) {
        column.reach = far;
        column.is_settled = false;
    }
    columns_[start].row = row;
    columns_[start].reach = 0;
    std::size_t end = start;
    while (columns_[end].row != nobody) {
        columns_[end].is_settled = true;
        reach_from(costs, end);
        end = nearest_open(); // there is one: each row can stay alone
    }
    pay(columns_[end].reach);
    for (; end != start; end = columns_[end].before) columns_[end].row = columns_[columns_[end].before].row;
    columns_[start].row = nobody;
}

void Assigner::reach_from(const Costs& costs, std::size_t column) noexcept {
    const Column& here = columns_[column];
    for (std::size_t next = 0; next + 1 < columns_.size(); ++next) {
        Column& there = columns_[next];
        if (there.is_settled) continue;
        const double length = here.reach + cost(costs, here.row, next) - row_prices_[here.row] - there.price;
        if (!(length < there.reach)) continue;
        there.reach = length;
        there.before = column;
    }
}

std::size_t Assigner::nearest_open() const noexcept {
    std::size_t nearest = columns_.size() - 1;
    double reach = far;
    for (std::size_t column = 0; column + 1 < columns_.size(); ++column) {
        if (columns_[column].is_settled || !(columns_[column].reach < reach)) continue;
        nearest = column;
        reach = columns_[column].reach;
    }
    return nearest;
}

/// Prices under which the new rows' columns are the cheapest each can have.
void Assigner::pay(double length) noexcept {
    for (Column& column : columns_) {
        if (!column.is_settled) continue;
        row_prices_[column.row] += length - column.reach;
        column.price -= length - column.reach;
    }
    columns_.back().price = 0;
}

Pairing assign(const Costs& costs, double limit) {
    Assigner assigner(costs.rows(), costs.columns());
    const auto pairs = assigner.assign(costs, limit);
    return {pairs.begin(), pairs.end()};
}

} // namespace locus::vision
