#include "fusion/vision/survey/floor_sight.h"

#include "fusion/geometry/rotation.h"

#include <Eigen/LU>

namespace locus::vision::survey {
namespace {

using Mat3 = Eigen::Matrix3d;

Mat3 shift(const Eigen::Vector2d& by_m) {
    Mat3 moves = Mat3::Identity();
    moves.col(2).head<2>() = by_m;
    return moves;
}

/// E of a homography's step.
Mat3 change_of(const ViewStep& step) {
    Mat3 change;
    change << step[0], step[1], step[2], step[3], step[4], step[5], step[6], step[7], 0;
    return change;
}

/// E x by the eight elements of E, x homogeneous.
Eigen::Matrix<double, 3, 8> by_change(const Eigen::Vector2d& x_m) {
    Eigen::Matrix<double, 3, 8> by = Eigen::Matrix<double, 3, 8>::Zero();
    by.block<1, 3>(0, 0) = by.block<1, 3>(1, 3) = x_m.homogeneous().transpose();
    by.block<1, 2>(2, 6) = x_m.transpose();
    return by;
}

std::optional<FloorSight> through(const Camera& camera, const Eigen::Vector2d& site_m) {
    const Eigen::Vector3d arm_m = camera.camera_from_site.leftCols<2>() * site_m;
    const auto sight = project(camera.lens, arm_m + camera.site_in_camera_m);
    if (!sight) return std::nullopt;
    FloorSight out{sight->pixel_px, sight->by_ray * camera.camera_from_site.leftCols<2>(), ByView(2, 6)};
    out.by_view.leftCols<3>() = -sight->by_ray * skew(arm_m);
    out.by_view.rightCols<3>() = sight->by_ray;
    return out;
}

std::optional<FloorSight> through(const FloorHomography& view, const Eigen::Vector2d& site_m,
                                  const Eigen::Vector2d& centre_m) {
    const Mat3 pixel_from_floor = view.floor_from_pixel.inverse();
    const Eigen::Vector3d shown = pixel_from_floor * site_m.homogeneous();
    if (!(shown.z() > 0)) return std::nullopt;
    Eigen::Matrix<double, 2, 3> by_shown;
    by_shown << 1, 0, -shown.x() / shown.z(), 0, 1, -shown.y() / shown.z();
    by_shown /= shown.z();
    FloorSight out{shown.hnormalized(), by_shown * pixel_from_floor.leftCols<2>(), ByView(2, 8)};
    out.by_view = by_shown * (pixel_from_floor * shift(centre_m)) * by_change(site_m - centre_m);
    return out;
}

Camera moved_camera(Camera camera, const ViewStep& step) {
    camera.camera_from_site = rotation(step.head<3>()).toRotationMatrix() * camera.camera_from_site;
    camera.site_in_camera_m += step.tail<3>();
    return camera;
}

} // namespace

int view_parameters(const FloorView& view) noexcept { return std::holds_alternative<Camera>(view) ? 6 : 8; }

std::optional<FloorSight> sight_of(const FloorView& view, const Eigen::Vector2d& site_m,
                                   const Eigen::Vector2d& centre_m) noexcept {
    if (const auto* camera = std::get_if<Camera>(&view)) return through(*camera, site_m);
    return through(*std::get_if<FloorHomography>(&view), site_m, centre_m);
}

FloorView moved(const FloorView& view, const ViewStep& step, const Eigen::Vector2d& centre_m) noexcept {
    if (const auto* camera = std::get_if<Camera>(&view)) return moved_camera(*camera, step);
    const Mat3& floor_from_pixel = std::get_if<FloorHomography>(&view)->floor_from_pixel;
    const Mat3 change = shift(centre_m) * (Mat3::Identity() + change_of(step)) * shift(-centre_m);
    return FloorHomography{change.inverse() * floor_from_pixel};
}

bool is_seen_from_above(const FloorView& view) noexcept {
    if (const auto* camera = std::get_if<Camera>(&view)) return camera->position_site_m().z() > 0;
    return std::get_if<FloorHomography>(&view)->floor_from_pixel.determinant() < 0;
}

} // namespace locus::vision::survey
