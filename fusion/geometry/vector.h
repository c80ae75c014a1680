// Points of the configuration and of measurements (Vec3) as Eigen's vectors.
#pragma once

#include "fusion/measurement.h"

#include <Eigen/Core>

namespace locus {

inline Eigen::Vector3d vector(const Vec3& v) { return {v[0], v[1], v[2]}; }

} // namespace locus
