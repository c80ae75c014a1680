#include "fusion/vision/scale/key_places.h"

#include <algorithm>

namespace locus::vision {
namespace {

KeyPlace joined(const KeyPlace& a, const KeyPlace& b) {
    const double weight = a.weight + b.weight, share = a.weight / weight;
    return {share * a.position_odometry + (1 - share) * b.position_odometry,
            share * a.position_site_m + (1 - share) * b.position_site_m, weight};
}

} // namespace

void KeyPlaces::add(const KeyPlace& place) noexcept {
    if (size_ == capacity) join_closest();
    places_[size_++] = place;
}

void KeyPlaces::join_closest() noexcept {
    const auto apart = [this](std::size_t i) {
        return (places_[i + 1].position_odometry - places_[i].position_odometry).squaredNorm();
    };
    std::size_t closest = 0;
    for (std::size_t i = 1; i + 1 < size_; ++i)
        if (apart(i) < apart(closest)) closest = i;
    places_[closest] = joined(places_[closest], places_[closest + 1]);
    for (std::size_t i = closest + 2; i < size_; ++i) places_[i - 1] = places_[i];
    --size_;
}

} // namespace locus::vision
