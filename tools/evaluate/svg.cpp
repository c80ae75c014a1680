#include "tools/evaluate/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace locus::evaluate {

namespace {

constexpr std::string_view grid_colour = "#e3e6ea", label_colour = "#5f6b7a";

std::string_view name(TextAnchor anchor) {
    constexpr std::string_view names[] = {"start", "middle", "end"};
    return names[static_cast<int>(anchor)];
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) {
        if (c == '<')
            result += "&lt;";
        else if (c == '&')
            result += "&amp;";
        else
            result += static_cast<unsigned char>(c) < 0x20 ? '?' : c;
    }
    return result;
}

std::string attributes(const Stroke& stroke) {
    const std::string dashes = stroke.dashes.empty() ? "" : fmt::format(" stroke-dasharray=\"{}\"", stroke.dashes);
    return fmt::format(R"(fill="none" stroke="{}" stroke-width="{}"{} stroke-linejoin="round")", stroke.colour,
                       stroke.width_px, dashes);
}

bool finite(Pixel p) { return std::isfinite(p.x) && std::isfinite(p.y); }

} // namespace

Svg::Svg(double width_px, double height_px)
    : body_(
          fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" "
                      "font-family=\"Helvetica, Arial, sans-serif\">\n"
                      "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
                      width_px, height_px)) {}

void Svg::line(Pixel from, Pixel to, const Stroke& stroke) {
    body_ +=
        fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" {}/>\n", from.x, from.y, to.x, to.y, attributes(stroke));
}

void Svg::curve(std::span<const Pixel> points, const Stroke& stroke) {
    constexpr double least_px = 0.4;
    std::string path;
    Pixel last{};
    bool pen_down = false;
    for (const Pixel p : points) {
        if (finite(p) && pen_down && std::hypot(p.x - last.x, p.y - last.y) < least_px) continue;
        if (finite(p)) path += fmt::format("{}{:.1f} {:.1f}", pen_down ? 'L' : 'M', p.x, p.y);
        pen_down = finite(p);
        last = p;
    }
    if (!path.empty()) body_ += fmt::format("<path d=\"{}\" {}/>\n", path, attributes(stroke));
}

void Svg::dot(Pixel at, double radius_px, std::string_view colour) {
    body_ += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"/>\n", at.x, at.y, radius_px, colour);
}

void Svg::text(Pixel at, std::string_view text, double size_px, std::string_view colour, TextAnchor anchor) {
    body_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" fill=\"{}\" text-anchor=\"{}\">{}</text>\n",
                         at.x, at.y, size_px, colour, name(anchor), escaped(text));
}

std::vector<double> ticks(Interval interval, int wanted) {
    const double rough = interval.length() / std::max(wanted, 1);
    if (!(rough > 0) || !std::isfinite(rough)) return {};
    const double power = std::pow(10, std::floor(std::log10(rough)));
    const double lead = rough / power;
    const double step = power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
    std::vector<double> result;
    const double first = std::ceil(interval.low / step), last = std::floor(interval.high / step);
    for (int i = 0; i <= last - first; ++i) result.push_back((first + i) * step);
    return result;
}

Pixel Axes::operator()(double x, double y) const {
    return {top_left_.x + (x - x_.low) / x_.length() * width_px(),
            bottom_right_.y - (y - y_.low) / y_.length() * height_px()};
}

void Axes::draw(Svg& svg, std::span<const double> x_ticks, std::span<const double> y_ticks, std::string_view x_title,
                std::string_view y_title) const {
    constexpr double size_px = 11;
    for (const double x : x_ticks) {
        const double at = (*this)(x, y_.low).x;
        svg.line({at, top_left_.y}, {at, bottom_right_.y}, {grid_colour});
        svg.text({at, bottom_right_.y + 15}, fmt::format("{:.6g}", x), size_px, label_colour, TextAnchor::middle);
    }
    for (const double y : y_ticks) {
        const double at = (*this)(x_.low, y).y;
        svg.line({top_left_.x, at}, {bottom_right_.x, at}, {grid_colour});
        svg.text({top_left_.x - 6, at + 4}, fmt::format("{:.6g}", y), size_px, label_colour, TextAnchor::end);
    }
    svg.text({(top_left_.x + bottom_right_.x) / 2, bottom_right_.y + 32}, x_title, size_px, label_colour,
             TextAnchor::middle);
    svg.text({top_left_.x, top_left_.y - 8}, y_title, size_px, label_colour);
}

void Axes::draw(Svg& svg, std::string_view x_title, std::string_view y_title) const {
    constexpr double pixels_a_tick_x = 70, pixels_a_tick_y = 45;
    draw(svg, ticks(x_, static_cast<int>(width_px() / pixels_a_tick_x)),
         ticks(y_, static_cast<int>(height_px() / pixels_a_tick_y)), x_title, y_title);
}

} // namespace locus::evaluate
