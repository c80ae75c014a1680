#include "drivers/camera/region.h"

#include "drivers/camera/person_shape.h"

#include <charconv>

namespace locus::camera {
namespace {

/// A number in 0..1 at the front of `text`, which is taken off.
std::optional<float> take_share(std::string_view& text) {
    float value = 0;
    const auto result = std::from_chars(text.begin(), text.end(), value);
    if (result.ec != std::errc{} || !(value >= 0 && value <= 1)) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(result.ptr - text.begin()));
    return value;
}

bool take(std::string_view& text, char letter) {
    if (!text.starts_with(letter)) return false;
    text.remove_prefix(1);
    return true;
}

} // namespace

std::optional<Region> Region::parse(std::string_view text) {
    Region region;
    while (!text.empty()) {
        if (take(text, ' ')) continue;
        const auto x = take_share(text);
        if (!x || !take(text, ',')) return std::nullopt;
        const auto y = take_share(text);
        if (!y) return std::nullopt;
        region.corners_.push_back({*x, *y});
    }
    if (!region.corners_.empty() && region.corners_.size() < 3) return std::nullopt;
    return region;
}

/// A ray to the right crosses the edges an odd number of times from inside.
bool Region::has_feet_of(const vision::BoxPx& box, int image_width_px, int image_height_px) const {
    const float x = foot_x_px(box) / static_cast<float>(image_width_px);
    const float y = box.bottom_px() / static_cast<float>(image_height_px);
    bool inside = corners_.empty();
    for (std::size_t i = 0; i < corners_.size(); ++i) {
        const Corner& a = corners_[i];
        const Corner& b = corners_[(i + 1) % corners_.size()];
        const bool crosses = (a.y > y) != (b.y > y) && x < a.x + (b.x - a.x) * (y - a.y) / (b.y - a.y);
        inside = inside != crosses;
    }
    return inside;
}

} // namespace locus::camera
