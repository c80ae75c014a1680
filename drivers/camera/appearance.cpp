#include "drivers/camera/appearance.h"

#include "drivers/camera/mat.h"
#include "fusion/vision/colours.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace locus::camera {
namespace {

/// Where the parts of a standing body are, from the top, in shares of its height (Drillis and Contini 1966: chin at
/// 0.87 and hips at 0.53 of the stature from the ground). The middle half of the width shows more person than
/// background.
struct Part {
    double from, to;
};
constexpr std::array<Part, 3> body_parts{{{0, 0.13}, {0.13, 0.47}, {0.47, 1}}};
constexpr double side_share = 0.25;

/// Hue means nothing where there is hardly colour or light, so those pixels count by their value alone.
constexpr int hue_bins = 8, saturation_bins = 4, value_bins = 8;
constexpr int bins_of_part = hue_bins * saturation_bins + value_bins;
constexpr int least_saturation = 32, least_value = 32; // of 255
constexpr int hue_range = 180;                         // OpenCV keeps hues in bytes
constexpr int least_pixels = 8;

constexpr int greys_of_looks = 4;
constexpr int looks_of_part = hue_bins + greys_of_looks;
static_assert((body_parts.size() - 1) * looks_of_part == std::tuple_size_v<Looks>);

cv::Rect part_of(const vision::BoxPx& box, const Part& part, const cv::Size& image) {
    const double left = box.left_px + side_share * box.width_px;
    const double top = box.top_px + part.from * box.height_px;
    const double bottom = box.top_px + part.to * box.height_px;
    const cv::Rect2d rect{left, top, (1 - 2 * side_share) * box.width_px, bottom - top};
    return cv::Rect{cv::Point(rect.tl()), cv::Point(rect.br())} & cv::Rect{{0, 0}, image};
}

int bin_of(const cv::Vec3b& hsv) {
    if (hsv[1] < least_saturation || hsv[2] < least_value)
        return hue_bins * saturation_bins + hsv[2] * value_bins / 256;
    return hsv[0] * hue_bins / hue_range * saturation_bins + hsv[1] * saturation_bins / 256;
}

constexpr int bin_of_looks(int bin) {
    const int grey = bin - hue_bins * saturation_bins;
    return grey < 0 ? bin / saturation_bins : hue_bins + grey * greys_of_looks / value_bins;
}

/// Adds square roots of shares to `to`; a part that is not seen stays zero.
void describe(const cv::Mat& bgr, float* to) {
    if (bgr.total() < least_pixels) return;
    cv::Mat_<cv::Vec3b> hsv;
    cv::cvtColor(bgr, hsv, cv::COLOR_BGR2HSV);
    for (const auto& pixel : hsv) to[std::min(bin_of(pixel), bins_of_part - 1)] += 1;
    for (int i = 0; i < bins_of_part; ++i) to[i] = std::sqrt(to[i] / static_cast<float>(bgr.total()));
}

} // namespace

vision::Appearance appearance(const Picture& picture, const vision::BoxPx& box) {
    if (picture.channels != 3) return {};
    const cv::Mat image = as_mat(picture);
    vision::Appearance look(body_parts.size() * bins_of_part, 0);
    for (std::size_t i = 0; i < body_parts.size(); ++i)
        describe(image(part_of(box, body_parts[i], image.size())), look.data() + i * bins_of_part);
    const double length = cv::norm(look);
    if (length == 0) return {};
    for (float& value : look) value = static_cast<float>(value / length);
    return look;
}

Looks looks(const vision::Appearance& appearance) noexcept {
    if (appearance.size() != body_parts.size() * bins_of_part) return {};
    vision::Colours shares = vision::Colours::Zero();
    std::size_t at = bins_of_part; // the head says little
    for (int part = 1; part < static_cast<int>(body_parts.size()); ++part)
        for (int bin = 0; bin < bins_of_part; ++bin) {
            const float root = appearance[at++];
            shares((part - 1) * looks_of_part + bin_of_looks(bin)) += root * root;
        }
    const float sum = shares.sum();
    return sum > 0 ? vision::looks_of(shares / sum) : Looks{};
}

} // namespace locus::camera
