#include "tools/evaluate/plot.h"

#include "tools/evaluate/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace locus::evaluate {

namespace {

constexpr Stroke truth_stroke{"#b6bec8", 3}, estimate_stroke{"#1565c0", 1.4}, plane_stroke{"#e06c00", 1.8};
constexpr std::string_view dark = "#1f2933";
constexpr double page_width_px = 1040, page_height_px = 640;
constexpr double gap_s = 1; ///< without a point for longer, the line is broken

struct Curve {
    std::vector<double> time_s;
    std::vector<Eigen::Vector3d> position_m;
    void add(double time, const Eigen::Vector3d& position) {
        time_s.push_back(time);
        position_m.push_back(position);
    }
};

Curve truth_curve(const Track& truth, std::span<const Pair> pairs) {
    Curve curve;
    for (const auto& point : truth)
        if (point.time_s >= pairs.front().time_s && point.time_s <= pairs.back().time_s)
            curve.add(point.time_s, point.position_m);
    if (curve.time_s.empty())
        for (const auto& pair : pairs) curve.add(pair.time_s, pair.truth_m);
    return curve;
}

Curve estimate_curve(std::span<const Pair> pairs, const Similarity& similarity) {
    Curve curve;
    for (const auto& pair : pairs) curve.add(pair.time_s, similarity(pair.estimate_m));
    return curve;
}

// With a margin, and never so small that nothing could be told apart.
Interval padded(double low, double high, double least_length) {
    const double half = std::max({0.55 * (high - low), least_length / 2, 1e-6 * std::abs(high)});
    return {(low + high) / 2 - half, (low + high) / 2 + half};
}

template <class Value>
Interval span_of(const Curve& a, const Curve& b, double least_length, Value value) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Curve* curve : {&a, &b})
        for (const auto& position : curve->position_m) {
            low = std::min(low, value(position));
            high = std::max(high, value(position));
        }
    return padded(low, high, least_length);
}

// One metre is as long to the right as upwards.
void square_up(Interval& x, Interval& y, double width_px, double height_px) {
    const double metres_a_pixel = std::max(x.length() / width_px, y.length() / height_px);
    const auto widen = [](Interval& i, double length) {
        const double middle = (i.low + i.high) / 2;
        i = {middle - length / 2, middle + length / 2};
    };
    widen(x, metres_a_pixel * width_px);
    widen(y, metres_a_pixel * height_px);
}

template <class Map>
void draw_curve(Svg& svg, const Curve& curve, const Stroke& stroke, Map map) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    std::vector<Pixel> pixels;
    for (std::size_t i = 0; i < curve.time_s.size(); ++i) {
        if (i > 0 && curve.time_s[i] - curve.time_s[i - 1] > gap_s) pixels.push_back({nan, nan});
        pixels.push_back(map(curve.time_s[i], curve.position_m[i]));
    }
    svg.curve(pixels, stroke);
}

void draw_from_above(Svg& svg, const Curve& truth, const Curve& estimate) {
    const Pixel top_left{60, 90}, bottom_right{560, 590};
    Interval x = span_of(truth, estimate, 0.1, [](const auto& p) { return p.x(); });
    Interval y = span_of(truth, estimate, 0.1, [](const auto& p) { return p.y(); });
    square_up(x, y, bottom_right.x - top_left.x, bottom_right.y - top_left.y);
    const Axes axes(top_left, bottom_right, x, y);
    axes.draw(svg, "x, m", "y, m: from above");
    const auto above = [&](double, const Eigen::Vector3d& p) { return axes(p.x(), p.y()); };
    draw_curve(svg, truth, truth_stroke, above);
    draw_curve(svg, estimate, estimate_stroke, above);
    svg.dot(above(0, estimate.position_m.front()), 4, estimate_stroke.colour);
}

void draw_height(Svg& svg, const Curve& truth, const Curve& estimate) {
    const double start_s = estimate.time_s.front();
    const Axes axes({640, 400}, {1010, 590}, {0, std::max(estimate.time_s.back() - start_s, 0.1)},
                    span_of(truth, estimate, 0.1, [](const auto& p) { return p.z(); }));
    axes.draw(svg, "time since the first pose compared, s", "z, m");
    const auto over_time = [&](double time_s, const Eigen::Vector3d& p) { return axes(time_s - start_s, p.z()); };
    draw_curve(svg, truth, truth_stroke, over_time);
    draw_curve(svg, estimate, estimate_stroke, over_time);
}

void draw_share(Svg& svg, const Axes& axes, const std::vector<double>& sorted, const Stroke& stroke) {
    std::vector<Pixel> pixels;
    const auto count = static_cast<double>(sorted.size());
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        pixels.push_back(axes(sorted[i], 100 * static_cast<double>(i) / count));
        pixels.push_back(axes(sorted[i], 100 * static_cast<double>(i + 1) / count));
    }
    svg.curve(pixels, stroke);
}

// Up to the error that 99 % stay below: one wild point must not press the rest to the wall.
std::vector<double> shown(std::vector<double>& errors, double limit) {
    return {errors.begin(), std::ranges::upper_bound(errors, limit)};
}

void draw_distribution(Svg& svg, std::span<const Pair> pairs, const Similarity& similarity) {
    std::vector<double> spatial, plane;
    for (const auto& error : errors(pairs, similarity)) {
        spatial.push_back(error.norm());
        plane.push_back(error.head<2>().norm());
    }
    std::ranges::sort(spatial);
    std::ranges::sort(plane);
    const double limit = std::max(1.05 * quantile(spatial, 0.99), 1e-3);
    const Axes axes({640, 90}, {1010, 330}, {0, limit}, {0, 100});
    constexpr double shares[] = {0, 20, 50, 80, 95};
    axes.draw(svg, ticks({0, limit}, 5), shares, "error, m", "% of poses with at most this error");
    draw_share(svg, axes, shown(spatial, limit), estimate_stroke);
    draw_share(svg, axes, shown(plane, limit), plane_stroke);
}

void legend(Svg& svg, Pixel at, const Stroke& stroke, std::string_view text) {
    svg.line({at.x, at.y - 4}, {at.x + 22, at.y - 4}, stroke);
    svg.text({at.x + 28, at.y}, text, 12, dark);
}

} // namespace

std::string plot(const Track& truth, std::span<const Pair> pairs, const Similarity& similarity,
                 const std::string& title) {
    Svg svg(page_width_px, page_height_px);
    const Curve true_curve = truth_curve(truth, pairs), estimated = estimate_curve(pairs, similarity);
    svg.text({60, 36}, title, 17, dark);
    legend(svg, {60, 62}, truth_stroke, "truth");
    legend(svg, {140, 62}, estimate_stroke, "estimate");
    const Statistics figures = statistics(pairs, similarity);
    legend(svg, {640, 62}, estimate_stroke, fmt::format("3D, RMSE {:.3f} m", figures.spatial.rmse_m));
    legend(svg, {820, 62}, plane_stroke, fmt::format("horizontal, RMSE {:.3f} m", figures.horizontal.rmse_m));
    draw_from_above(svg, true_curve, estimated);
    draw_distribution(svg, pairs, similarity);
    draw_height(svg, true_curve, estimated);
    return svg.str();
}

} // namespace locus::evaluate
