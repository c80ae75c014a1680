// Whose tag is whose track: a camera sees people without names, tags have names but say less well where they are. Both
// are put side by side on the floor, over a window and not in a single image, and assigned at the least total distance
// (paper 000 eq. 27-28, with Mahalanobis distances and room for people without a tag and tags without a person).
#pragma once

#include "fusion/option.h"
#include "fusion/vision/assignment.h"
#include "fusion/vision/look_book.h"
#include "fusion/vision/naming.h"
#include "fusion/vision/tag_numbers.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace locus::vision {

struct IdentitySettings {
    double window_s = 0.7; ///< shorter than the 1 s that a swap may last
    double gate = 9.2103;  ///< 99 % of chi-square with two degrees of freedom
    double loyalty = 1;    ///< twice this, for two who swap, is the mean of that chi-square: as much as chance may make
    double settle_s = 0.3; ///< a few images, for a name that is not one image's chance
    double sigma_m = 0.5;  ///< a usual fix of a tag beside a foot point; wider ones prove less
    double forget_s = 5;   ///< somewhat longer than a tracker keeps who is lost
    double keep_s = 0;     ///< tags that are told apart in every window need no memory, and a tracker's swap has none
    double looks_weight = 0; ///< nothing gained where tags are known to half a metre (docs/cameras.md)
};

template <class Settings>
inline constexpr std::array identity_options{
    option<&IdentitySettings::window_s, Settings>("window_s", "s", 0.01, 60,
                                                  "Time constant over which distances are averaged."),
    option<&IdentitySettings::gate, Settings>("gate", "", 1, 100,
                                              "Largest mean squared Mahalanobis distance of a track and its tag."),
    option<&IdentitySettings::loyalty, Settings>("loyalty", "", 0, 100,
                                                 "By how much another tag must be nearer to take over a track."),
    option<&IdentitySettings::settle_s, Settings>("settle_s", "s", 0, 60,
                                                  "Time that both must have been seen before they are a pair."),
    option<&IdentitySettings::sigma_m, Settings>("sigma_m", "m", 0.01, 100,
                                                 "Usual standard deviation between the two; wider ones prove less."),
    option<&IdentitySettings::forget_s, Settings>("forget_s", "s", 0, 3600,
                                                  "When a track or tag not seen for so long is forgotten."),
    option<&IdentitySettings::keep_s, Settings>(
        "keep_s", "s", 0, 3600,
        "Time in which the confidence of a pair fades that stays together where "
        "nothing tells it from others; 0: at once. For tags that are known to "
        "metres only, who are not told apart in a crowd."),
    option<&IdentitySettings::looks_weight, Settings>(
        "looks_weight", "", 0, 100,
        "hungarian: by how much looking like a tag's wearer brings a track nearer, and looking "
        "unlike him farther, in squared Mahalanobis distances.")};

class Identity final : public Naming {
  public:
    /// For so many tags in all; more are passed over. No allocation after this.
    Identity(const IdentitySettings& settings, std::size_t max_tags, CameraLooks looks = {});

    /// A tag that is not located just now keeps its track. The confidence is of the tag against all others of the
    /// track, all other tracks of the tag, and none; or what is left of what it was before, for as long as the two stay
    /// together.
    std::span<const Named> update(Timestamp time, std::span<const SeenPerson> people,
                                  std::span<const LocatedTag> tags) noexcept override;

  private:
    static constexpr std::uint16_t nobody = TagNumbers::none;

    struct Evidence {
        double mean = 0; ///< of the squared distance, gate and doubt included
        double weighed_s = 0;
        Timestamp last = never;
    };
    struct Track {
        std::uint32_t number = 0;
        Timestamp last = never;      ///< when he was seen; never: the place is free
        std::uint16_t held = nobody; ///< his tag
        double confidence = 0;       ///< of that, as it was in the last image
    };
    static constexpr Timestamp never = Timestamp::min();

    std::size_t place_of(std::uint32_t track, Timestamp time) noexcept;
    Evidence& evidence(std::size_t track, std::size_t tag) noexcept { return evidence_[track * max_tags_ + tag]; }
    const Evidence& evidence(std::size_t track, std::size_t tag) const noexcept {
        return evidence_[track * max_tags_ + tag];
    }
    void clear(std::size_t track) noexcept;
    void weigh(Timestamp time, const SeenPerson& person, std::size_t track, const LocatedTag& tag) noexcept;
    double looks_term(const SeenPerson& person, Address tag) const noexcept;
    void learn_looks(Timestamp time, std::span<const SeenPerson> people) const noexcept;
    void forget(Timestamp time) noexcept;
    void assign_tags() noexcept;
    void hold(std::size_t track, std::uint16_t tag, double kept) noexcept;
    double cost(std::size_t track, std::size_t tag) const noexcept;
    double confidence(std::size_t track, std::size_t tag) const noexcept;
    Named named(std::size_t track) const noexcept;

    IdentitySettings settings_;
    std::size_t max_tags_;
    CameraLooks looks_;
    TagNumbers tags_;
    std::vector<Track> tracks_;              ///< max_people places
    std::vector<Evidence> evidence_;         ///< a row for each track
    std::vector<std::size_t> seen_;          ///< places of the people of this image
    std::vector<std::uint16_t> held_before_; ///< by them, in the image before
    std::vector<Named> named_;
    Costs costs_;
    Assigner assigner_;
};

} // namespace locus::vision
