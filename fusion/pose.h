// Pose: what a client gets for one target at one tick.
#pragma once

#include "fusion/measurement.h"

#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <type_traits>

namespace locus {

/// What stands between a target and a pose; `nothing` when there is one.
enum class Missing : std::uint8_t {
    nothing,
    measurements,
    anchors,
    geometry,
    agreement,
    fresh_measurements,
    site_origin,
    count_
};

inline constexpr std::array<std::string_view, static_cast<std::size_t>(Missing::count_)> missing_sentences{
    "nothing",
    "no measurement of this target has come yet",
    "too few anchors are heard for a first position",
    "the anchors heard stand so that no single position follows from them: if they are all at one height, set "
    "`planar: true` and `height_m` (locus config --reference); if on one line, add an anchor beside it",
    "the first measurements do not agree on a position",
    "nothing heard of this target for too long",
    "the site does not say where on the Earth it lies: set site.origin (locus config --reference)",
};

constexpr std::string_view missing_sentence(Missing missing) {
    return missing_sentences[static_cast<std::size_t>(missing)];
}

/// What is known of the scale of a monocular odometry that goes into a pose.
struct OdometryScale {
    double metres_per_unit = std::numeric_limits<double>::quiet_NaN(); ///< NaN: unknown
    float relative_sigma = unknown_f;                                  ///< its bound, also while it is unknown
};

/// An estimator's state as seen from outside, at one time, site frame (right-handed, z up).
struct Estimate {
    Timestamp time{};
    Vec3 position_site_m{};
    Vec3 velocity_site_mps{};
    std::array<double, 4> orientation_xyzw{}; ///< body to site; all zero when not known
    /// Row-major 6 x 6 of (position, velocity), m^2, m^2/s, m^2/s^2.
    std::array<double, 36> covariance{};
    std::uint32_t kinds_used = 0; ///< bit i: Observation alternative i went in within the last second
    std::uint32_t reset_count = 0;
    OdometryScale odometry_scale;
    Missing missing = Missing::measurements; ///< not `nothing`: the other fields mean nothing
};

/// The camera track that a target was last known by.
struct SeenAs {
    Address camera = no_address; ///< no_address: by none within the last second
    std::uint32_t track = 0;
    float confidence = 0; ///< 0..1 that it is this target; 0 of a target without a tag
};

struct Pose {
    Address target = no_address;
    std::uint16_t target_index = 0;
    std::uint16_t estimator = 0; ///< row of estimator_table()
    Timestamp published{};
    float horizontal_error_95_m = 0; ///< radius that holds the true point with 95 % probability
    float vertical_error_95_m = 0;
    SeenAs seen_as;
    Estimate estimate;
};

static_assert(std::is_trivially_copyable_v<Pose>);

} // namespace locus
