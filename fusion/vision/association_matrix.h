// Which tag a person in a camera's view carries, by paper 003 section 4: for every pair of a track and a tag it is
// averaged over time how often both were near each other (eq. 2-3) and how alike they looked (eq. 4-5); the association
// matrix blends the two (eq. 1). A pair stands while its element does, so a wrong one is undone when the evidence
// turns. Time constants instead of the paper's factors for each image, since images come at any rate.
#pragma once

#include "fusion/option.h"
#include "fusion/vision/look_book.h"
#include "fusion/vision/naming.h"
#include "fusion/vision/tag_numbers.h"

#include <array>
#include <vector>

namespace locus::vision {

/// The paper tells none of these numbers. In equal shares; as long as a radio that is known to metres needs for its
/// errors to change; about the error of a radio's place; more likely than not.
struct AssociationSettings {
    double trajectory_share = 0.5;
    double trajectory_time_s = 5;
    double looks_time_s = 5;
    double near_m = 3;
    double least_element = 0.5;
};

template <class Settings>
inline constexpr std::array association_options{
    option<&AssociationSettings::trajectory_share, Settings>(
        "trajectory_share", "", 0, 1, "matrix: what having been near counts for; having looked alike counts the rest."),
    option<&AssociationSettings::trajectory_time_s, Settings>(
        "trajectory_time_s", "s", 0.01, 3600, "matrix: time constant over which it is averaged who was near whom."),
    option<&AssociationSettings::looks_time_s, Settings>("looks_time_s", "s", 0.01, 3600,
                                                         "matrix: time constant over which likeness is averaged."),
    option<&AssociationSettings::near_m, Settings>("near_m", "m", 0.01, 1000,
                                                   "matrix: how far apart a track and its tag may seem."),
    option<&AssociationSettings::least_element, Settings>("least_element", "", 0, 1,
                                                          "matrix: what a pair's element must exceed.")};

class AssociationMatrix final : public Naming {
  public:
    /// For so many tags in all; more are passed over. No allocation after this.
    AssociationMatrix(const AssociationSettings& settings, std::size_t max_tags, CameraLooks looks = {});

    /// A name is given where the element exceeds the threshold and all others of its row and of its column; it is the
    /// confidence. Tags look as those tracks did that had their names before; until there is one, any track looks
    /// alike.
    std::span<const Named> update(Timestamp time, std::span<const SeenPerson> people,
                                  std::span<const LocatedTag> tags) noexcept override;

  private:
    static constexpr Timestamp never = Timestamp::min();

    struct Similarity {
        double trajectory = 0, looks = 0;
    };
    struct Track {
        std::uint32_t number = 0;
        Timestamp last = never; ///< when he was seen; never: the place is free
    };

    Similarity& similarity(std::size_t track, std::size_t tag) noexcept { return pairs_[track * max_tags_ + tag]; }
    const Similarity& similarity(std::size_t track, std::size_t tag) const noexcept {
        return pairs_[track * max_tags_ + tag];
    }
    void fade(Timestamp time) noexcept;
    void clear(std::size_t track) noexcept;
    std::size_t place_of(std::uint32_t track) noexcept;
    void meet(double dt_s, std::size_t track, const std::optional<Colours>& seen, const LocatedTag& tag) noexcept;
    double element(std::size_t track, std::size_t tag) const noexcept;
    bool is_largest(std::size_t track, std::size_t tag) const noexcept;
    Named named(std::size_t track) const noexcept;

    AssociationSettings settings_;
    std::size_t max_tags_;
    CameraLooks looks_;
    TagNumbers tags_;
    std::vector<Track> tracks_;     ///< max_people places
    std::vector<Similarity> pairs_; ///< a row for each track
    std::vector<std::size_t> seen_; ///< places of the people of this image
    std::vector<Named> named_;
    Timestamp last_ = never;
};

} // namespace locus::vision
