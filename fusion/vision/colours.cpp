#include "fusion/vision/colours.h"

#include <algorithm>
#include <cmath>

namespace locus::vision {

std::optional<Colours> colours_of(const Looks& looks) noexcept {
    const auto roots = Eigen::Map<const Eigen::Array<std::uint8_t, Colours::SizeAtCompileTime, 1>>(looks.data());
    const Colours squares = roots.cast<float>().square();
    const float sum = squares.sum();
    if (!(sum > 0)) return std::nullopt;
    return squares / sum;
}

Looks looks_of(const Colours& colours) noexcept {
    Looks looks{};
    for (std::size_t i = 0; i < looks.size(); ++i)
        looks[i] = static_cast<std::uint8_t>(
            std::lround(255 * std::sqrt(std::clamp(colours(static_cast<Eigen::Index>(i)), 0.F, 1.F))));
    return looks;
}

double bhattacharyya_distance(const Colours& p, const Colours& q) noexcept {
    return std::sqrt(std::max(0.0, 1 - double{(p * q).sqrt().sum()}));
}

} // namespace locus::vision
