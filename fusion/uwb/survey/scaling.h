// A first shape out of distances alone, in no frame: classical multidimensional scaling, with the shortest way through
// the measured pairs in place of a pair that was not measured (Shang, Ruml, Zhang and Fromherz, "Localization from mere
// connectivity", 2003, MDS-MAP).
#pragma once

#include "fusion/uwb/survey/network.h"

#include <Eigen/Core>

#include <vector>

namespace locus::uwb::survey {

/// Distances between all stations; infinite between groups that no pair joins. `pairs` name stations below `count`.
Eigen::MatrixXd shortest_ways(const std::vector<PairRange>& pairs, std::size_t count);

/// For each station the lowest number among those that measured pairs join it with.
std::vector<std::size_t> groups(const Eigen::MatrixXd& ways_m);

/// The `dimensions` (2 or 3) strongest coordinates of the doubly centred squared distances (Torgerson 1952); z is 0 of
/// two. All distances finite.
Positions classical_scaling(const Eigen::MatrixXd& distances_m, int dimensions);

} // namespace locus::uwb::survey
