#include "drivers/camera/height_grid.h"

#include "drivers/camera/person_shape.h"

#include <algorithm>

namespace locus::camera {
namespace {

constexpr int cell_px = 4; // a pixel of height at most from its middle to its border

int cell_of(float at_px, int cells) { return std::clamp(static_cast<int>(at_px) / cell_px, 0, cells - 1); }

cv::Mat1f cells_of(const cv::Size& picture, const HeightMap& heights) {
    cv::Mat1f cells((picture.height + cell_px - 1) / cell_px, (picture.width + cell_px - 1) / cell_px);
    const auto middle = [](int cell) { return static_cast<float>(cell * cell_px) + 0.5F * cell_px; };
    for (int row = 0; row < cells.rows; ++row)
        for (int column = 0; column < cells.cols; ++column)
            cells(row, column) = heights.at(middle(column), middle(row)).value_or(0);
    return cells;
}

std::vector<vision::BoxPx> standing_places(const cv::Size& picture, const HeightMap& heights) {
    std::vector<vision::BoxPx> places;
    for (int y = 1; y <= picture.height;) {
        int step = 2;
        for (int x = 0; x < picture.width;) {
            const auto height = heights.at(static_cast<float>(x), static_cast<float>(y));
            step = height ? std::max(1, static_cast<int>(*height / 24)) : 4;
            if (height) places.push_back(standing_box(static_cast<float>(x), static_cast<float>(y), *height));
            x += step;
        }
        y += step;
    }
    return places;
}

} // namespace

void HeightGrid::refresh(const HeightMap& heights, const cv::Size& picture) {
    if (!heights.is_known() || (picture == picture_ && heights.revision() == revision_ && !cells_.empty())) return;
    picture_ = picture;
    revision_ = heights.revision();
    cells_ = cells_of(picture, heights);
    standing_ = standing_places(picture, heights);
}

bool HeightGrid::is_possible(const vision::BoxPx& box) const {
    if (cells_.empty()) return true;
    const float expected_px = cells_(cell_of(box.bottom_px(), cells_.rows), cell_of(foot_x_px(box), cells_.cols));
    return expected_px > 0 && has_expected_height(box.height_px, expected_px);
}

} // namespace locus::camera
