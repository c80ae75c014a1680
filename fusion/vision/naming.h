// What gives a camera's tracks the names of tags: the shape that identity.h (Hungarian) and association_matrix.h have
// in common.
#pragma once

#include "fusion/measurement.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

namespace locus::vision {

struct SeenPerson {
    std::uint32_t track = 0;
    Eigen::Vector2d position_site_m;
    Eigen::Matrix2d covariance_m2;
    Looks looks{};
};

/// At the time of the image, so predicted to it.
struct LocatedTag {
    Address tag = no_address;
    Eigen::Vector2d position_site_m;
    Eigen::Matrix2d covariance_m2;
};

struct Named {
    std::uint32_t track = 0;
    std::optional<Address> tag; ///< empty: nobody's, or not known yet
    double confidence = 0;      ///< 0..1
};

inline constexpr std::size_t max_people = 64; ///< that are told apart at a time

class Naming {
  public:
    virtual ~Naming() = default;

    /// One entry for each of `people`, in their order; beyond max_people nobody has a name. Times rise. Valid until the
    /// next call.
    virtual std::span<const Named> update(Timestamp time, std::span<const SeenPerson> people,
                                          std::span<const LocatedTag> tags) noexcept = 0;
};

} // namespace locus::vision
