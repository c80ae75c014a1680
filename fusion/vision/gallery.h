// How a person looked lately (DeepSORT): the likeness of a detection is that to the most alike of them, so that
// somebody who turned round is known by his back and by his face.
#pragma once

#include "fusion/vision/detection.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace locus::vision {

class Gallery {
  public:
    explicit Gallery(std::size_t most) : most_(most) {}

    void add(const Appearance& appearance) {
        if (appearance.empty() || most_ == 0) return;
        if (pictures_.size() < most_)
            pictures_.push_back(appearance);
        else
            pictures_[next_] = appearance;
        next_ = (next_ + 1) % most_;
    }

    /// One minus the largest dot product; empty when either side is not known or their sizes differ.
    std::optional<double> distance(const Appearance& appearance) const {
        std::optional<double> least;
        for (const Appearance& picture : pictures_) {
            if (picture.size() != appearance.size()) continue;
            const double alike = std::inner_product(picture.begin(), picture.end(), appearance.begin(), 0.0);
            least = std::min(least.value_or(2), 1 - alike);
        }
        return least;
    }

  private:
    std::size_t most_;
    std::size_t next_ = 0;
    std::vector<Appearance> pictures_;
};

} // namespace locus::vision
