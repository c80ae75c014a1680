// Where a SLAM's path says the target is, once the path lies in the site. What the alignment is off by is the same for
// every pose of it, so a filter carries that error along as a state: the path's shape counts at once, its place only
// for what the alignment is worth.
#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace locus {

struct AlignedPlace {
    Eigen::Vector3d position_site_m = Eigen::Vector3d::Zero();
    Eigen::Vector3d held_sigma_m = Eigen::Vector3d::Zero(); ///< of the error that is held, each axis
    Eigen::Vector3d held_time_s = Eigen::Vector3d::Ones();  ///< in which that error becomes another one
    double noise_sigma_m = 0.02;                            ///< of what is new each time
    std::uint32_t alignment = 0; ///< another number: its error has nothing to do with that of the ones before
};

} // namespace locus
