#include "drivers/camera/regions.h"

#include "drivers/camera/person_shape.h"

#include <opencv2/imgproc.hpp>

namespace locus::camera {
namespace {

/// How far from a box's end its feet may be: two to three deviations of a detector's boxes.
constexpr float near_the_end = 0.15F;

vision::BoxPx to_box(const cv::Rect& rect) {
    return {static_cast<float>(rect.x), static_cast<float>(rect.y), static_cast<float>(rect.width),
            static_cast<float>(rect.height)};
}

} // namespace

std::vector<vision::Detection> regions_as_people(const cv::Mat& foreground, float least_height_px) {
    cv::Mat labels;
    cv::Mat statistics;
    cv::Mat centres;
    const int count = cv::connectedComponentsWithStats(foreground, labels, statistics, centres);
    std::vector<vision::Detection> regions;
    for (int i = 1; i < count; ++i) { // 0 is the background
        const auto value = [&](int column) { return statistics.at<int>(i, column); };
        const cv::Rect rect{value(cv::CC_STAT_LEFT), value(cv::CC_STAT_TOP), value(cv::CC_STAT_WIDTH),
                            value(cv::CC_STAT_HEIGHT)};
        const auto filled = static_cast<float>(value(cv::CC_STAT_AREA)) / static_cast<float>(rect.area());
        if (static_cast<float>(rect.height) >= least_height_px) regions.push_back({to_box(rect), filled, {}});
    }
    return regions;
}

bool is_lone_person(const vision::Detection& region, const cv::Size& image) {
    const vision::BoxPx& box = region.box;
    const float aspect = box.width_px / box.height_px;
    const bool inside = box.left_px > 0 && box.top_px > 0 && box.right_px() < static_cast<float>(image.width) &&
                        box.bottom_px() < static_cast<float>(image.height);
    return inside && aspect > person_aspect / 2 && aspect < person_aspect * 1.5F && region.score > 0.4F;
}

std::optional<float> lowest_moving_px(const cv::Mat& foreground, const vision::BoxPx& box) {
    const float reach_px = near_the_end * box.height_px;
    const cv::Rect around{cv::Point(static_cast<int>(box.left_px), static_cast<int>(box.bottom_px() - reach_px)),
                          cv::Point(static_cast<int>(box.right_px()), static_cast<int>(box.bottom_px() + reach_px))};
    const cv::Rect inside = around & cv::Rect{{0, 0}, foreground.size()};
    if (inside.height < around.height || inside.empty()) return std::nullopt;
    const cv::Rect moving = cv::boundingRect(foreground(inside));
    if (moving.empty() || moving.br().y >= inside.height) return std::nullopt;
    return static_cast<float>(inside.y + moving.br().y);
}

} // namespace locus::camera
