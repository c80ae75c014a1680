#include "fusion/vision/camera_model.h"

#include <Eigen/LU>

#include <cmath>

namespace locus::vision {
namespace {

/// `floor` with the covariance that a pixel's gives where the floor moves the pixel by `pixel_by_floor`. Empty where a
/// pixel is no point of the floor any more.
std::optional<FloorPoint> with_covariance(const Eigen::Vector2d& floor_m, const Eigen::Matrix2d& floor_by_pixel,
                                          const Eigen::Matrix2d& covariance_px2) noexcept {
    const FloorPoint point{floor_m, floor_by_pixel * covariance_px2 * floor_by_pixel.transpose()};
    const bool is_good = point.position_site_m.allFinite() && point.covariance_m2.allFinite();
    return is_good ? std::optional(point) : std::nullopt;
}

std::optional<FloorPoint> on_plane(const Camera& camera, const PixelPoint& seen, double height_m,
                                   double height_sigma_m) noexcept {
    const auto ray = unproject(camera.lens, seen.pixel_px);
    if (!ray) return std::nullopt;
    const Eigen::Vector3d direction = camera.camera_from_site.transpose() * *ray;
    const Eigen::Vector3d from_m = camera.position_site_m();
    const double distance_m = (height_m - from_m.z()) / direction.z();
    if (!(distance_m > 0) || !std::isfinite(distance_m)) return std::nullopt;
    const Eigen::Vector3d there_m = from_m + distance_m * direction;
    const auto sight = look_at(camera, {there_m.x(), there_m.y(), height_m});
    if (!sight) return std::nullopt;
    auto point = with_covariance(there_m.head<2>(), sight->by_ray.leftCols<2>().inverse(), seen.covariance_px2);
    if (!point) return point;
    const Eigen::Vector2d by_height = height_sigma_m / direction.z() * direction.head<2>();
    point->covariance_m2 += by_height * by_height.transpose();
    return point;
}

std::optional<FloorPoint> by_homography(const FloorHomography& view, const PixelPoint& seen) noexcept {
    const Eigen::Vector3d there = view.floor_from_pixel * seen.pixel_px.homogeneous();
    if (!(there.z() > 0)) return std::nullopt;
    const Eigen::Vector2d floor_m = there.hnormalized();
    const Eigen::Matrix2d by_pixel =
        (view.floor_from_pixel.topLeftCorner<2, 2>() - floor_m * view.floor_from_pixel.bottomLeftCorner<1, 2>()) /
        there.z();
    return with_covariance(floor_m, by_pixel, seen.covariance_px2);
}

} // namespace

FloorHomography floor_homography(const Eigen::Matrix3d& floor_from_pixel, const Eigen::Vector2d& seen_px) noexcept {
    const double side = floor_from_pixel.row(2).dot(seen_px.homogeneous());
    return {side < 0 ? Eigen::Matrix3d(-floor_from_pixel) : floor_from_pixel};
}

std::optional<FloorPoint> foot_on_floor(const FloorView& view, const PixelPoint& foot) noexcept {
    if (const auto* camera = std::get_if<Camera>(&view)) return on_plane(*camera, foot, 0, 0);
    return by_homography(*std::get_if<FloorHomography>(&view), foot);
}

std::optional<FloorPoint> foot_below_head(const FloorView& view, const PixelPoint& head,
                                          const BodyHeight& body) noexcept {
    const auto* camera = std::get_if<Camera>(&view);
    return camera ? on_plane(*camera, head, body.height_m, body.sigma_m) : std::nullopt;
}

std::optional<Eigen::Vector2d> pixel_of_floor(const FloorView& view, const Eigen::Vector2d& position_site_m) noexcept {
    if (const auto* camera = std::get_if<Camera>(&view)) {
        const auto sight = look_at(*camera, {position_site_m.x(), position_site_m.y(), 0});
        return sight ? std::optional(sight->pixel_px) : std::nullopt;
    }
    const Eigen::Matrix3d& floor_from_pixel = std::get_if<FloorHomography>(&view)->floor_from_pixel;
    const Eigen::Vector3d pixel = floor_from_pixel.inverse() * position_site_m.homogeneous();
    return pixel.z() > 0 && pixel.allFinite() ? std::optional<Eigen::Vector2d>(pixel.hnormalized()) : std::nullopt;
}

std::optional<Sight> look_at(const Camera& camera, const Eigen::Vector3d& position_site_m) noexcept {
    auto sight = project(camera.lens, camera.camera_from_site * position_site_m + camera.site_in_camera_m);
    if (sight) sight->by_ray *= camera.camera_from_site;
    return sight;
}

FloorView scaled(const FloorView& view, const Eigen::Vector2d& factor) noexcept {
    if (const auto* camera = std::get_if<Camera>(&view)) {
        Camera other = *camera;
        other.lens = scaled(camera->lens, factor);
        return other;
    }
    FloorHomography other = *std::get_if<FloorHomography>(&view);
    other.floor_from_pixel *= Eigen::Vector3d(1 / factor.x(), 1 / factor.y(), 1).asDiagonal();
    return other;
}

} // namespace locus::vision
