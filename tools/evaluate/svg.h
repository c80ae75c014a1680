// As much of SVG as a plot needs: lines, text, and a box with axes that maps metres to pixels.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace locus::evaluate {

struct Pixel {
    double x = 0, y = 0;
};

enum class TextAnchor { start, middle, end };

struct Stroke {
    std::string_view colour;
    double width_px = 1;
    std::string_view dashes{};
};

class Svg {
  public:
    Svg(double width_px, double height_px);

    void line(Pixel from, Pixel to, const Stroke& stroke);
    /// Points closer than a fraction of a pixel to the last one drawn are left out. Points that are not finite break
    /// it.
    void curve(std::span<const Pixel> points, const Stroke& stroke);
    void dot(Pixel at, double radius_px, std::string_view colour);
    void text(Pixel at, std::string_view text, double size_px, std::string_view colour,
              TextAnchor anchor = TextAnchor::start);

    /// The whole file.
    std::string str() const { return body_ + "</svg>\n"; }

  private:
    std::string body_;
};

struct Interval {
    double low = 0, high = 1;
    double length() const { return high - low; }
};

/// Round values, 1, 2 or 5 times a power of ten apart, about `wanted` of them within the interval.
std::vector<double> ticks(Interval interval, int wanted);

/// A rectangle of the picture that stands for a rectangle of values; y upwards.
class Axes {
  public:
    Axes(Pixel top_left, Pixel bottom_right, Interval x, Interval y)
        : top_left_(top_left), bottom_right_(bottom_right), x_(x), y_(y) {}

    Pixel operator()(double x, double y) const;

    /// Grid lines, figures at them, and what the axes stand for.
    void draw(Svg& svg, std::span<const double> x_ticks, std::span<const double> y_ticks, std::string_view x_title,
              std::string_view y_title) const;
    void draw(Svg& svg, std::string_view x_title, std::string_view y_title) const;

    double width_px() const { return bottom_right_.x - top_left_.x; }
    double height_px() const { return bottom_right_.y - top_left_.y; }

  private:
    Pixel top_left_, bottom_right_;
    Interval x_, y_;
};

} // namespace locus::evaluate
