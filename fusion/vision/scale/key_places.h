// Where a SLAM and the site's own sensors say the target was at the same moments: a bounded set, for the rough start of
// an alignment. When it is full, the two neighbours that lie closest together in the SLAM's path become one.
#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <span>

namespace locus::vision {

struct KeyPlace {
    Eigen::Vector3d position_odometry = Eigen::Vector3d::Zero();
    Eigen::Vector3d position_site_m = Eigen::Vector3d::Zero();
    double weight = 1; ///< as of a variance's inverse
};

class KeyPlaces {
  public:
    static constexpr std::size_t capacity = 64;

    void clear() noexcept { size_ = 0; }
    void add(const KeyPlace& place) noexcept;
    std::span<const KeyPlace> all() const noexcept { return {places_.data(), size_}; }

  private:
    void join_closest() noexcept;

    std::array<KeyPlace, capacity> places_{};
    std::size_t size_ = 0;
};

} // namespace locus::vision
