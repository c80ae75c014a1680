#include "fusion/uwb/survey/frame.h"

#include <Eigen/Dense>

namespace locus::uwb::survey {
namespace {

Eigen::Vector3d place_of(const Positions& positions_m, std::size_t station) {
    return positions_m.row(static_cast<Eigen::Index>(station)).transpose();
}

double off_line_m(const Positions& shape_m, std::size_t a, std::size_t b, std::size_t station) {
    const Eigen::Vector3d along = (place_of(shape_m, b) - place_of(shape_m, a)).normalized();
    return along.cross(place_of(shape_m, station) - place_of(shape_m, a)).norm();
}

/// Into the axes (columns) through the origin; what the convention says is 0 is 0 to the last digit.
Positions turned(const Positions& shape_m, const FrameStations& frame, const Eigen::Vector3d& origin_m,
                 const Eigen::Matrix3d& axes, int dimensions) {
    const auto station = [&](std::size_t i) { return static_cast<Eigen::Index>(frame[i]); };
    Positions placed_m = (shape_m.rowwise() - origin_m.transpose()) * axes;
    placed_m.row(station(0)).head(dimensions).setZero();
    placed_m(station(1), 1) = 0;
    if (dimensions == 3) placed_m(station(1), 2) = placed_m(station(2), 2) = 0;
    return placed_m;
}

} // namespace

Positions mirrored(const Positions& shape_m, int dimensions) {
    Positions image_m = shape_m;
    image_m.col(dimensions - 1) *= -1;
    return image_m;
}

FrameStations frame_stations(const Positions& shape_m) {
    constexpr double clearly = 0.2; // of the first two's distance
    const double base_m = (place_of(shape_m, 1) - place_of(shape_m, 0)).norm();
    FrameStations frame{0, 1, 2};
    for (std::size_t other = 2; other < static_cast<std::size_t>(shape_m.rows()); ++other) {
        if (off_line_m(shape_m, 0, 1, frame[2]) >= clearly * base_m) break;
        if (off_line_m(shape_m, 0, 1, other) > off_line_m(shape_m, 0, 1, frame[2])) frame[2] = other;
    }
    return frame;
}

Positions by_convention(const Positions& shape_m, const FrameStations& frame, int dimensions, bool third_on_right) {
    Eigen::Vector3d origin_m = place_of(shape_m, frame[0]);
    Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();
    if (dimensions == 2) {
        origin_m.z() = 0;
        const Eigen::Vector2d x = (place_of(shape_m, frame[1]) - origin_m).head<2>().normalized();
        axes.topLeftCorner<2, 2>() << x.x(), -x.y(), x.y(), x.x();
        return turned(shape_m, frame, origin_m, axes, dimensions);
    }
    const Eigen::Vector3d x = (place_of(shape_m, frame[1]) - origin_m).normalized();
    const Eigen::Vector3d aside_m = place_of(shape_m, frame[2]) - origin_m;
    const Eigen::Vector3d y = (third_on_right ? -1 : 1) * (aside_m - x.dot(aside_m) * x).normalized();
    axes << x, y, x.cross(y);
    return turned(shape_m, frame, origin_m, axes, dimensions);
}

Positions by_known(const Positions& shape_m, const std::vector<std::size_t>& known, const Positions& known_m,
                   int dimensions) {
    Eigen::MatrixXd own(dimensions, known.size()), wanted(dimensions, known.size());
    for (std::size_t i = 0; i < known.size(); ++i) {
        own.col(static_cast<Eigen::Index>(i)) = place_of(shape_m, known[i]).head(dimensions);
        wanted.col(static_cast<Eigen::Index>(i)) = place_of(known_m, known[i]).head(dimensions);
    }
    const Eigen::MatrixXd motion = Eigen::umeyama(own, wanted, false);
    const Eigen::MatrixXd turn = motion.topLeftCorner(dimensions, dimensions);
    const Eigen::RowVectorXd shift_m = motion.topRightCorner(dimensions, 1).transpose();
    Positions placed_m = shape_m;
    placed_m.leftCols(dimensions) = (shape_m.leftCols(dimensions) * turn.transpose()).rowwise() + shift_m;
    return placed_m;
}

bool spans(const Positions& points_m, int dimensions, double least_m) {
    if (points_m.rows() <= dimensions) return false;
    const Positions centred_m = points_m.rowwise() - points_m.colwise().mean();
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(centred_m);
    return svd.singularValues()(dimensions - 1) >= least_m;
}

} // namespace locus::uwb::survey
