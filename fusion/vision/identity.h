// Whose tag is whose track: a camera sees people without names, tags have names but say less well where they are. Both
// are put side by side on the floor, over a window and not in a single image, and assigned at the least total distance
// (paper 000 eq. 27-28, with Mahalanobis distances and room for people without a tag and tags without a person).
#pragma once

#include "fusion/option.h"
#include "fusion/time.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace locus::vision {

struct IdentitySettings {
    double window_s = 0.7; ///< shorter than the 1 s that a swap may last
    double gate = 9.2103;  ///< 99 % of chi-square with two degrees of freedom
    double loyalty = 1;    ///< twice this, for two who swap, is the mean of that chi-square: as much as chance may make
    double settle_s = 0.3; ///< a few images, for a name that is not one image's chance
    double sigma_m = 0.5;  ///< a usual fix of a tag beside a foot point; wider ones prove less
    double forget_s = 5;   ///< somewhat longer than a tracker keeps who is lost
};

inline constexpr std::array identity_options{
    option<&IdentitySettings::window_s>("window_s", "s", 0.01, 60, "Time constant over which distances are averaged."),
    option<&IdentitySettings::gate>("gate", "", 1, 100,
                                    "Largest mean squared Mahalanobis distance of a track and its tag."),
    option<&IdentitySettings::loyalty>("loyalty", "", 0, 100,
                                       "By how much another tag must be nearer to take over a track."),
    option<&IdentitySettings::settle_s>("settle_s", "s", 0, 60,
                                        "Time that both must have been seen before they are a pair."),
    option<&IdentitySettings::sigma_m>("sigma_m", "m", 0.01, 100,
                                       "Usual standard deviation between the two; wider ones prove less."),
    option<&IdentitySettings::forget_s>("forget_s", "s", 0, 3600,
                                        "When a track or tag not seen for so long is forgotten.")};

struct SeenPerson {
    std::uint32_t track = 0;
    Eigen::Vector2d position_site_m;
    Eigen::Matrix2d covariance_m2;
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
    double confidence = 0; ///< 0..1, of the tag against all others of the track, all other tracks of the tag, and none
};

class Identity {
  public:
    explicit Identity(const IdentitySettings& settings) : settings_(settings) {}

    /// One entry for each of `people`, in their order. A tag that is not located just now keeps its track. Times rise.
    std::span<const Named> update(Timestamp time, std::span<const SeenPerson> people, std::span<const LocatedTag> tags);

  private:
    struct Evidence {
        double mean = 0; ///< of the squared distance, gate and doubt included
        double weighed_s = 0;
        Timestamp last{};
    };
    using Pair = std::pair<std::uint32_t, Address>;

    IdentitySettings settings_;
    std::map<Pair, Evidence> evidence_;
    std::map<std::uint32_t, Address> held_; ///< the tag of each track
    std::vector<Named> named_;

    void weigh(Timestamp time, const SeenPerson& person, const LocatedTag& tag);
    void forget(Timestamp time);
    void assign_tags(std::span<const SeenPerson> people);
    double cost(std::uint32_t track, Address tag) const;
    double confidence(std::uint32_t track, Address tag) const;
};

} // namespace locus::vision
