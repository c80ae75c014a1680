#include "drivers/camera/yolo_head.h"

#include <cmath>

namespace locus::camera {
namespace {

constexpr int box_numbers = 4;

std::string shape_text(const cv::Mat& output) {
    std::string text;
    for (int i = 0; i < output.dims; ++i) text += (i > 0 ? "x" : "") + std::to_string(output.size[i]);
    return text;
}

/// Rows of predictions, whatever way round they came; empty when there are none.
cv::Mat as_rows(const cv::Mat& output, bool is_column_wise) {
    if (output.type() != CV_32F || output.empty()) return {};
    if (output.dims == 2) return is_column_wise ? cv::Mat{output.t()} : output;
    if (output.dims != 3 || output.size[0] != 1) return {};
    const cv::Mat flat = output.reshape(1, output.size[1]);
    return is_column_wise ? cv::Mat{flat.t()} : flat;
}

std::string_view head_of(const cv::Mat& output, const YoloHead& head) {
    if (head.name != "auto") return head.name;
    if (output.dims == 2) return "v3";
    return output.dims == 3 && output.size[1] < output.size[2] ? "v8" : "v5"; // there are more places than classes
}

bool all_finite(const float* row, int count) {
    for (int i = 0; i < count; ++i)
        if (!std::isfinite(row[i])) return false;
    return true;
}

} // namespace

std::string decode(const cv::Mat& output, const YoloHead& head, const cv::Size& input,
                   std::vector<vision::Detection>& people) {
    const std::string_view kind = head_of(output, head);
    const cv::Mat rows = as_rows(output, kind == "v8");
    const int first_class = kind == "v8" ? box_numbers : box_numbers + 1;
    const int column = first_class + head.person_class;
    if (rows.empty() || rows.cols <= column)
        return "its output of " + shape_text(output) + " is none of a YOLO " + std::string{kind} + " head with class " +
               std::to_string(head.person_class);
    const auto width_px = static_cast<float>(kind == "v3" ? input.width : 1);
    const auto height_px = static_cast<float>(kind == "v3" ? input.height : 1);
    for (int i = 0; i < rows.rows; ++i) {
        const auto* row = rows.ptr<float>(i);
        const float score = kind == "v5" ? row[box_numbers] * row[column] : row[column];
        if (!(score >= head.least_score) || !std::isfinite(score) || !all_finite(row, box_numbers)) continue;
        const float wide = row[2] * width_px;
        const float high = row[3] * height_px;
        if (wide > 0 && high > 0)
            people.push_back({{row[0] * width_px - wide / 2, row[1] * height_px - high / 2, wide, high}, score, {}});
    }
    return {};
}

} // namespace locus::camera
