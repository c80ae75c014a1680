#include "fusion/vision/survey/floor_start.h"

#include "fusion/geometry/rotation.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include <cmath>
#include <vector>

namespace locus::vision::survey {
namespace {

/// Of squared singular values: below it the second smallest is as good as zero in double precision.
constexpr double least_rank_share = 1e-11;

/// Moves points so that their mean is the origin and their mean square distance 2 (Hartley 1997).
Eigen::Matrix3d conditioner(std::span<const FloorPair> pairs, const Eigen::Vector2d FloorPair::* side) {
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    for (const FloorPair& pair : pairs) mean += pair.*side / static_cast<double>(pairs.size());
    double square = 0;
    for (const FloorPair& pair : pairs) square += (pair.*side - mean).squaredNorm() / static_cast<double>(pairs.size());
    const double scale = square > 0 ? std::sqrt(2 / square) : 1;
    Eigen::Matrix3d moves = Eigen::Vector3d(scale, scale, 1).asDiagonal();
    moves.col(2).head<2>() = -scale * mean;
    return moves;
}

/// The rays of all pixels, or nothing where one has none.
std::vector<Eigen::Vector3d> rays_of(std::span<const FloorPair> pairs, const std::optional<Lens>& lens,
                                     const Eigen::Matrix3d& condition) {
    std::vector<Eigen::Vector3d> rays;
    for (const FloorPair& pair : pairs)
        if (!lens.has_value())
            rays.emplace_back(condition * pair.pixel_px.homogeneous());
        else if (const auto ray = unproject(*lens, pair.pixel_px))
            rays.push_back(*ray);
    return rays;
}

/// H with ray x (H place) = 0, of unit length, positive where most rays look.
std::optional<Eigen::Matrix3d> linear_fit(const std::vector<Eigen::Vector3d>& rays,
                                          const std::vector<Eigen::Vector3d>& places) {
    using Mat9 = Eigen::Matrix<double, 9, 9>;
    Mat9 normal = Mat9::Zero();
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Eigen::Matrix3d cross = skew(rays[i].normalized());
        Eigen::Matrix<double, 3, 9> rows;
        for (int column = 0; column < 3; ++column) rows.middleCols<3>(3 * column) = places[i][column] * cross;
        normal += rows.transpose() * rows;
    }
    const Eigen::SelfAdjointEigenSolver<Mat9> values(normal);
    if (!(values.eigenvalues()[1] > least_rank_share * values.eigenvalues()[8])) return std::nullopt;
    Eigen::Matrix3d fit = values.eigenvectors().col(0).reshaped(3, 3);
    double side = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) side += rays[i].dot(fit * places[i]) > 0 ? 1 : -1;
    if (side < 0) fit = -fit;
    return fit;
}

/// The nearest turn to the two columns that a homography shows of it, and the shift at the same scale.
Camera camera_of(const Lens& lens, const Eigen::Matrix3d& ray_from_floor) {
    const double scale = 2 / (ray_from_floor.col(0).norm() + ray_from_floor.col(1).norm());
    Eigen::Matrix3d turn = scale * ray_from_floor;
    const Eigen::Vector3d shift_m = turn.col(2);
    turn.col(2) = turn.col(0).cross(turn.col(1));
    const Eigen::JacobiSVD<Eigen::Matrix3d> parts(turn, Eigen::ComputeFullU | Eigen::ComputeFullV);
    return {lens, parts.matrixU() * parts.matrixV().transpose(), shift_m};
}

} // namespace

std::optional<FloorView> start_view(std::span<const FloorPair> pairs, const std::optional<Lens>& lens) {
    if (pairs.size() < least_pairs) return std::nullopt;
    const Eigen::Matrix3d from_pixel = conditioner(pairs, &FloorPair::pixel_px);
    const Eigen::Matrix3d from_site = conditioner(pairs, &FloorPair::site_m);
    const auto rays = rays_of(pairs, lens, from_pixel);
    if (rays.size() < pairs.size()) return std::nullopt;
    std::vector<Eigen::Vector3d> places;
    for (const FloorPair& pair : pairs) places.emplace_back(from_site * pair.site_m.homogeneous());
    const auto fit = linear_fit(rays, places);
    if (!fit) return std::nullopt;
    const Eigen::Matrix3d ray_from_floor = *fit * from_site;
    if (lens.has_value()) return camera_of(*lens, ray_from_floor);
    const Eigen::Matrix3d pixel_from_floor = from_pixel.inverse() * ray_from_floor;
    if (!(std::abs(fit->determinant()) > 1e-9)) return std::nullopt;
    return FloorHomography{pixel_from_floor.inverse()};
}

} // namespace locus::vision::survey
