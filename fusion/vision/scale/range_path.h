// Puts ranges onto the path of a SLAM. Key frames come seldom and irregularly, ranges at times of their own: each range
// waits for the next pose and lies between the two on a straight line, less sure by what the target may have
// accelerated meanwhile. What one anchor says within a third of a second becomes one row, because for so long its error
// is the same.
#pragma once

#include "fusion/time.h"
#include "fusion/vision/scale/range_rows.h"

#include <boost/container/static_vector.hpp>

#include <cstddef>

namespace locus::vision {

struct RangePathSettings {
    double held_sigma_m = 0.2;      ///< of an anchor's error that is the same within a window
    double window_s = 0.3;          ///< in which it becomes another one
    double acceleration_mps2 = 0.5; ///< of the target between two poses
    double longest_gap_s = 2;       ///< between poses; what is heard in a longer one is passed over
};

class RangePath {
  public:
    explicit RangePath(const RangePathSettings& settings) noexcept : settings_(settings) {}

    /// The path begins anew; what waits is forgotten.
    void clear() noexcept;

    /// In order of time, with the poses.
    void hear(const uwb::Sighting& sighting, Timestamp time) noexcept;

    /// A pose of the path. True: `rows` has grown.
    bool pass(const Eigen::Vector3d& position_odometry, Timestamp time, RangeRows& rows,
              double together_odometry) noexcept;

    const RangeRow& here() const noexcept { return here_; } ///< the newest pose, without a range

  private:
    struct Waiting {
        uwb::Sighting sighting;
        Timestamp time{};
    };
    struct Open {
        RangeRow row;
    };
    void lay(const Waiting& heard, const RangeRow& before, double gap_s) noexcept;
    bool close_window(RangeRows& rows, double together_odometry) noexcept;

    static constexpr std::size_t most_waiting = 256, most_open = 32;

    RangePathSettings settings_;
    boost::container::static_vector<Waiting, most_waiting> waiting_;
    boost::container::static_vector<Open, most_open> open_;
    RangeRow here_;
    Timestamp passed_{}, opened_{};
    bool has_begun_ = false;
};

} // namespace locus::vision
