#include "fusion/vision/scale/range_rows.h"

#include <algorithm>
#include <limits>

namespace locus::vision {

void RangeRow::join(const RangeRow& other) {
    const double sum = information_per_m2 + other.information_per_m2, share = other.information_per_m2 / sum;
    sighting.value_m += share * (other.sighting.value_m - sighting.value_m);
    position_odometry += share * (other.position_odometry - position_odometry);
    velocity_odometry_per_s += share * (other.velocity_odometry_per_s - velocity_odometry_per_s);
    gone_odometry += share * (other.gone_odometry - gone_odometry);
    information_per_m2 = sum;
}

void RangeRows::add(const RangeRow& row, double together_odometry) noexcept {
    if (size_ == capacity) make_room(together_odometry);
    rows_[size_++] = row;
}

std::size_t RangeRows::next_of_same(std::size_t row) const noexcept {
    for (std::size_t i = row + 1; i < size_; ++i)
        if (rows_[i].is_of_same(rows_[row])) return i;
    return size_;
}

void RangeRows::make_room(double together_odometry) noexcept {
    double least = together_odometry * together_odometry;
    std::size_t first = 0, second = size_;
    for (std::size_t i = 0; i < size_; ++i) {
        const std::size_t next = next_of_same(i);
        if (next == size_) continue;
        const double apart = (rows_[next].position_odometry - rows_[i].position_odometry).squaredNorm();
        if (apart >= least) continue;
        least = apart;
        first = i;
        second = next;
    }
    if (second != size_) rows_[first].join(rows_[second]);
    erase(second != size_ ? second : 0);
}

void RangeRows::erase(std::size_t row) noexcept {
    for (std::size_t i = row + 1; i < size_; ++i) rows_[i - 1] = rows_[i];
    --size_;
}

} // namespace locus::vision
