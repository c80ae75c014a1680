#include "tests/support/room/room_scene.h"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace locus::room {
namespace {

constexpr float texel_m = 0.005F;
constexpr int texture_px = 2048; ///< more than ten metres
constexpr int levels = 6;

/// Stains of all sizes, and things with straight edges: posters, tiles, shelves.
cv::Mat texture(cv::RNG& random, double contrast) {
    cv::Mat whole(texture_px, texture_px, CV_32F, cv::Scalar(128));
    for (const auto& [cell_px, sigma] : {std::pair{128, 18.}, {32, 10.}, {8, 8.}, {3, 5.}}) {
        cv::Mat coarse(texture_px / cell_px, texture_px / cell_px, CV_32F), fine;
        random.fill(coarse, cv::RNG::NORMAL, 0, sigma);
        cv::resize(coarse, fine, whole.size(), 0, 0, cv::INTER_CUBIC);
        whole += fine;
    }
    for (int i = 0; i < 260; ++i) {
        const cv::Point corner(random.uniform(0, texture_px), random.uniform(0, texture_px));
        const cv::Size size(random.uniform(6, 160), random.uniform(6, 160));
        cv::Mat thing = whole(cv::Rect(corner, size) & cv::Rect({0, 0}, whole.size()));
        thing = 0.4 * thing + 0.6 * random.uniform(20., 235.);
    }
    whole = 128 + contrast * (whole - 128);
    cv::GaussianBlur(whole, whole, {}, 0.8);
    return whole;
}

std::vector<cv::Mat> pyramid(const cv::Mat& finest) {
    std::vector<cv::Mat> all{finest};
    while (all.size() < levels) {
        cv::Mat next;
        cv::resize(all.back(), next, {}, 0.5, 0.5, cv::INTER_AREA);
        all.push_back(next);
    }
    return all;
}

float interpolated(const cv::Mat& level, float x, float y) {
    x = std::clamp(x, 0.F, static_cast<float>(level.cols) - 1.01F);
    y = std::clamp(y, 0.F, static_cast<float>(level.rows) - 1.01F);
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const float right = x - static_cast<float>(column), down = y - static_cast<float>(row);
    const float *upper = level.ptr<float>(row) + column, *lower = level.ptr<float>(row + 1) + column;
    return (1 - down) * ((1 - right) * upper[0] + right * upper[1]) +
           down * ((1 - right) * lower[0] + right * lower[1]);
}

} // namespace

RoomScene::RoomScene(unsigned seed, const Eigen::Vector3d& size_m, double contrast)
    : room_{Eigen::Array3f::Zero(), size_m.cast<float>().array(), 0} {
    cv::RNG random(seed * 7919 + 1);
    for (int i = 0; i < 12; ++i) textures_.push_back(pyramid(texture(random, contrast)));
    furnish(random);
}

/// Boxes along the walls, which leave a way of a metre and a half inside free, and a block in the middle.
void RoomScene::furnish(cv::RNG& random) {
    const Eigen::Array3f size = room_.high;
    for (int i = 0; i < 12; ++i) {
        const float along = random.uniform(0.F, 0.85F), deep = random.uniform(0.2F, 0.5F);
        const float wide = random.uniform(0.4F, 1.2F), high = random.uniform(0.5F, 2.2F);
        const int across = i % 2, side = i / 2 % 2;
        Box box{{0, 0, 0}, {0, 0, high}, 6U + static_cast<std::size_t>(i % 2) * 3};
        box.low[1 - across] = along * size[1 - across];
        box.high[1 - across] = std::min(box.low[1 - across] + wide, size[1 - across]);
        box.low[across] = side == 0 ? 0 : size[across] - deep;
        box.high[across] = box.low[across] + deep;
        furniture_.push_back(box);
    }
    const Eigen::Array3f middle = size / 2;
    furniture_.push_back({{middle.x() - 0.6F, middle.y() - 0.4F, 0}, {middle.x() + 0.6F, middle.y() + 0.4F, 1.0F}, 6});
}

vision::PinholeLens RoomScene::lens() {
    vision::PinholeLens lens;
    lens.focal_px = {focal_px, focal_px};
    lens.centre_px = {width_px / 2., height_px / 2.};
    return lens;
}

/// Slabs (Kay and Kajiya 1986): of the room the way out, of a box the way in.
RoomScene::Hit RoomScene::nearest(const Eigen::Array3f& from, const Eigen::Array3f& one_over,
                                  const std::vector<const Box*>& near) const {
    const Eigen::Array3f to_low = (room_.low - from) * one_over, to_high = (room_.high - from) * one_over;
    Hit hit;
    hit.distance = to_low.max(to_high).minCoeff(&hit.axis);
    hit.texture = static_cast<std::size_t>(2 * hit.axis + (one_over[hit.axis] > 0 ? 1 : 0));
    for (const Box* box : near) {
        const Eigen::Array3f a = (box->low - from) * one_over, b = (box->high - from) * one_over;
        int axis = 0;
        const float in = a.min(b).maxCoeff(&axis), out = a.max(b).minCoeff();
        if (in > 0 && in < out && in < hit.distance) hit = {in, axis, box->texture + static_cast<std::size_t>(axis)};
    }
    return hit;
}

float RoomScene::shade(const Hit& hit, const Eigen::Array3f& at, float pixel_m) const {
    const float u = at[hit.axis == 0 ? 1 : 0] / texel_m, v = at[hit.axis == 2 ? 1 : 2] / texel_m;
    const float finer = std::log2(std::max(pixel_m / texel_m, 1.F));
    const int level = std::min(static_cast<int>(finer), levels - 2);
    const float share = std::min(finer - static_cast<float>(level), 1.F);
    const auto& texture = textures_[hit.texture];
    const float scale = std::ldexp(1.F, -level);
    const float fine = interpolated(texture[static_cast<std::size_t>(level)], u * scale, v * scale);
    if (share < 0.01F) return fine;
    return (1 - share) * fine +
           share * interpolated(texture[static_cast<std::size_t>(level) + 1], u * scale / 2, v * scale / 2);
}

cv::Mat RoomScene::picture(const RoomView& view) const {
    const Eigen::Array3f from = view.position_m.cast<float>().array();
    const Eigen::Matrix3f turn = view.room_from_camera.toRotationMatrix().cast<float>();
    std::vector<const Box*> in_front; // only what reaches before the camera
    for (const Box& box : furniture_) {
        const Eigen::Vector3f middle = (0.5F * (box.low + box.high) - from).matrix();
        const float reach = 0.5F * (box.high - box.low).matrix().norm();
        if (turn.col(2).dot(middle) > -reach) in_front.push_back(&box);
    }
    cv::Mat image(height_px, width_px, CV_8U);
    for (int y = 0; y < height_px; ++y)
        for (int x = 0; x < width_px; ++x) {
            const Eigen::Vector3f slope((static_cast<float>(x) + 0.5F - width_px / 2.F) / static_cast<float>(focal_px),
                                        (static_cast<float>(y) + 0.5F - height_px / 2.F) / static_cast<float>(focal_px),
                                        1);
            const Eigen::Array3f ray = (turn * slope).array();
            const Hit hit = nearest(from, ray.inverse(), in_front);
            const float cosine = std::abs(ray[hit.axis]) / ray.matrix().norm();
            const float pixel_m = hit.distance / static_cast<float>(focal_px) / std::sqrt(std::max(cosine, 0.05F));
            image.at<std::uint8_t>(y, x) =
                cv::saturate_cast<std::uint8_t>(shade(hit, from + hit.distance * ray, pixel_m));
        }
    return image;
}

} // namespace locus::room
