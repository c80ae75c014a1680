// Self-survey: where anchors stand, from the distances they measured of each other. Multidimensional scaling gives a
// first shape, robust least squares the best one, a search over folded-over anchors the right one; known anchors or a
// convention give the frame. What distances cannot tell, which of two mirror images it is, is handed to the caller.
#pragma once

#include "fusion/uwb/survey/frame.h"
#include "fusion/uwb/survey/network.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace locus::uwb::survey {

/// What is known of a station before.
struct Station {
    std::optional<Eigen::Vector3d> known_site_m; ///< it is trusted and stays
    std::optional<double> height_site_m;         ///< z alone is trusted and stays
};

struct Task {
    std::vector<Station> stations;
    std::vector<PairRange> pairs; ///< each pair once, both ends below stations.size(), range and sigma above 0
    bool third_on_right = false;  ///< by convention in three dimensions: the third anchor at -y

    /// Two where every station's height is known, else three.
    int dimensions() const;
};

enum class Trouble {
    none,
    too_few_stations, ///< two, or three in three dimensions, make no frame
    disconnected,     ///< `about`: one station of each group
    known_too_few,    ///< some are known, but not enough for a frame
    known_in_line,    ///< those that are known stand in one line (or in one place, where heights are given)
    frame_in_line,    ///< none is known, and all stand in one line
    too_few_pairs,    ///< `about`: stations with fewer pairs than unknown coordinates
};

/// The two images differ most in where `station` is.
struct Mirror {
    std::size_t station = 0;
    bool by_height = false; ///< higher or lower; else left or right of the line `from` - `to`, seen from above
    std::size_t from = 0, to = 0;
};

/// An anchor that fits nearly as well somewhere else.
struct Doubt {
    std::size_t station = 0;
    Eigen::Vector3d also_at_m = Eigen::Vector3d::Zero();
};

struct Image {
    Adjustment adjustment;
    std::vector<Doubt> doubts;
};

struct Survey {
    Trouble trouble = Trouble::none;
    std::vector<std::size_t> about;
    std::vector<Image> images;    ///< one, or two that fit equally well: first higher, or left
    std::optional<Mirror> mirror; ///< set with two images
    bool by_convention = false;
    FrameStations frame{}; ///< of the convention
};

Survey survey(const Task& task);

} // namespace locus::uwb::survey
