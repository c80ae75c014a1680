// Which radio a person in a camera's view carries, by paper 003 section 4: for every pair of a track and a radio it is
// averaged over time how often both were near each other (eq. 2-3) and how alike they looked (eq. 4-5); the association
// matrix blends the two (eq. 1). A pair stands while its element does, so a wrong one is undone when the evidence
// turns.
#pragma once

#include "fusion/measurement.h"

#include <Eigen/Core>

#include <array>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace locus::radio {

/// Of colours; entries are not negative, their sum is one.
using Histogram = std::array<float, 16>;

/// sqrt(1 - sum sqrt(p q)): 0 alike, 1 nothing in common (Bhattacharyya 1943, in the form of Comaniciu et al. 2003).
double bhattacharyya_distance(const Histogram& p, const Histogram& q);

struct AssociationSettings {
    double trajectory_share = 0.5;  ///< alpha_a of eq. 1
    double trajectory_memory = 0.9; ///< alpha_k of eq. 3
    double appearance_memory = 0.9; ///< alpha_p of eq. 5
    double near_m = 3;              ///< threshold of eq. 2: about the error of a radio's place
    double least = 0.5;             ///< that an element of the matrix must exceed
};

struct SeenTrack {
    std::uint32_t track = 0;
    Eigen::Vector2d position_site_m{0, 0};
    Histogram colours{};
};

struct HeardRadio {
    Address radio = no_address;
    Eigen::Vector2d position_site_m{0, 0};
};

struct RadioPair {
    std::uint32_t track = 0;
    Address radio = no_address;
    double element = 0; ///< of the association matrix
};

class AssociationMatrix {
  public:
    explicit AssociationMatrix(const AssociationSettings& settings) : settings_(settings) {}

    /// One time frame. Pairs whose element exceeds the threshold and all others of its row and of its column; the
    /// radios' appearances are those of the tracks they were associated with before, and until there is one, any track
    /// looks alike.
    std::vector<RadioPair> update(std::span<const SeenTrack> tracks, std::span<const HeardRadio> radios);

  private:
    using Key = std::pair<std::uint32_t, Address>;
    struct Similarity {
        double trajectory = 0, appearance = 0;
    };
    double element(const Key& key) const;
    bool is_largest(const Key& key) const;
    void learn_looks(const SeenTrack& track, Address radio);
    double alike(const SeenTrack& track, Address radio) const;

    AssociationSettings settings_;
    std::map<Key, Similarity> pairs_;
    std::map<Address, Histogram> looks_;
};

} // namespace locus::radio
