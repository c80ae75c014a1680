// Colour histograms and how alike two are.
#pragma once

#include "fusion/measurement.h"

#include <Eigen/Core>

#include <optional>
#include <tuple>

namespace locus::vision {

/// Shares: not negative, of sum one.
using Colours = Eigen::Array<float, std::tuple_size_v<Looks>, 1>;

/// Empty: not known. Any bytes give shares.
std::optional<Colours> colours_of(const Looks& looks) noexcept;
/// The nearest that bytes can say.
Looks looks_of(const Colours& colours) noexcept;

/// sqrt(1 - sum sqrt(p q)): 0 alike, 1 nothing in common (Bhattacharyya 1943, in the form of Comaniciu et al. 2003).
double bhattacharyya_distance(const Colours& p, const Colours& q) noexcept;

} // namespace locus::vision
