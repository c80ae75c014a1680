// Whether a calibration is of images of this shape: one may be a smaller copy of the other, but no cut-out of it.
#pragma once

#include <Eigen/Core>
#include <fmt/format.h>

#include <cmath>
#include <string>

namespace locus {

/// A sentence; empty when the shapes are the same.
inline std::string trouble_of_shape(const std::string& path, const Eigen::Vector2d& made_px,
                                    const Eigen::Vector2d& size_px) {
    constexpr double same_shape = 0.01; // of height over width
    if (std::abs(size_px.y() / size_px.x() * made_px.x() / made_px.y() - 1) <= same_shape) return {};
    return fmt::format("{} was made with images of {:g}x{:g}, but the camera gives {:g}x{:g}, which is another "
                       "shape: calibrate it with this size, or set the other one",
                       path, made_px.x(), made_px.y(), size_px.x(), size_px.y());
}

} // namespace locus
