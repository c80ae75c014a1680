// What the similarity is fitted to: ranges, each with the point of the SLAM's path where it was measured. A bounded
// set: when it is full, two of the same anchor that lie closest together become one, so an hour of standing costs next
// to nothing and the path keeps its shape; where even the closest lie apart, the oldest goes.
#pragma once

#include "fusion/uwb/sighting.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <span>

namespace locus::vision {

struct RangeRow {
    uwb::Sighting sighting;        ///< without anchors: the height over the site's floor
    double information_per_m2 = 0; ///< inverse of its variance
    Eigen::Vector3d position_odometry = Eigen::Vector3d::Zero();
    Eigen::Vector3d velocity_odometry_per_s = Eigen::Vector3d::Zero();
    double gone_odometry = 0; ///< length of the SLAM's path up to here

    bool is_of_same(const RangeRow& other) const {
        return sighting.plus == other.sighting.plus && sighting.minus == other.sighting.minus;
    }
    bool is_height() const { return sighting.plus == uwb::Sighting::nobody; }
    /// Takes another of the same anchors in: the mean of both by information, true to first order.
    void join(const RangeRow& other);
};

class RangeRows {
  public:
    static constexpr std::size_t capacity = 640;

    void clear() noexcept { size_ = 0; }
    /// `together_odometry`: rows further apart are not joined, for ranges bend.
    void add(const RangeRow& row, double together_odometry) noexcept;
    std::span<const RangeRow> all() const noexcept { return {rows_.data(), size_}; }

  private:
    void make_room(double together_odometry) noexcept;
    std::size_t next_of_same(std::size_t row) const noexcept;
    void erase(std::size_t row) noexcept;

    std::array<RangeRow, capacity> rows_{}; ///< by time
    std::size_t size_ = 0;
};

} // namespace locus::vision
