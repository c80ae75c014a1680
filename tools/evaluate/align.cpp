#include "tools/evaluate/align.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <cmath>
#include <stdexcept>

namespace locus::evaluate {

namespace {

using Points = Eigen::Matrix3Xd;

// Relative to the largest extent: below it an extent is rounding.
constexpr double smallest_extent = 1e-9;

struct PointSets {
    Points estimate_m, truth_m;
};

PointSets columns(std::span<const Pair> pairs) {
    const auto size = static_cast<Eigen::Index>(pairs.size());
    PointSets sets{Points(3, size), Points(3, size)};
    for (Eigen::Index i = 0; i < size; ++i) {
        sets.estimate_m.col(i) = pairs[static_cast<std::size_t>(i)].estimate_m;
        sets.truth_m.col(i) = pairs[static_cast<std::size_t>(i)].truth_m;
    }
    return sets;
}

Points centred(const Points& points) { return points.colwise() - points.rowwise().mean(); }

// Extents along the principal axes, largest first.
Eigen::Vector3d extents(const Points& points) {
    const Points local = centred(points);
    const Eigen::Matrix3d scatter = local * local.transpose();
    return scatter.jacobiSvd().singularValues().cwiseSqrt();
}

// Distances beside which an extent would be lost in the rounding of the coordinates themselves.
double rounding(const Points& points) { return smallest_extent * (points.cwiseAbs().maxCoeff() + 1e-3); }

void require_turn_is_fixed(const Points& points, const char* whose) {
    const Eigen::Vector3d extent = extents(points);
    if (!(extent[1] > smallest_extent * extent[0] && extent[1] > rounding(points)))
        throw std::invalid_argument(std::string("the ") + whose +
                                    " stays on one line or at one place, so no turn in space follows: align with yaw");
}

Similarity yaw_alignment(const PointSets& sets) {
    const Points estimate = centred(sets.estimate_m), truth = centred(sets.truth_m);
    const double along = (estimate.topRows<2>().cwiseProduct(truth.topRows<2>())).sum();
    const double across = estimate.row(0).dot(truth.row(1)) - estimate.row(1).dot(truth.row(0));
    const double lost = rounding(sets.estimate_m) * rounding(sets.truth_m);
    if (!(std::hypot(along, across) > lost))
        throw std::invalid_argument("the tracks do not move in the plane, so no turn about z follows: align with none");
    Similarity result;
    result.rotation = Eigen::AngleAxisd(std::atan2(across, along), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    result.translation_m = sets.truth_m.rowwise().mean() - result.rotation * sets.estimate_m.rowwise().mean();
    return result;
}

Similarity space_alignment(const PointSets& sets, bool with_scale) {
    require_turn_is_fixed(sets.estimate_m, "estimate");
    require_turn_is_fixed(sets.truth_m, "truth");
    const Eigen::Matrix4d transform = Eigen::umeyama(sets.estimate_m, sets.truth_m, with_scale);
    const Eigen::Matrix3d scaled = transform.topLeftCorner<3, 3>();
    Similarity result;
    result.scale = with_scale ? std::cbrt(scaled.determinant()) : 1;
    result.rotation = scaled / result.scale;
    result.translation_m = transform.topRightCorner<3, 1>();
    return result;
}

} // namespace

Similarity align(std::span<const Pair> pairs, Alignment alignment) {
    if (alignment == Alignment::none) return {};
    if (pairs.size() < 2) throw std::invalid_argument("fewer than two points can be compared: nothing to align with");
    const PointSets sets = columns(pairs);
    if (alignment == Alignment::yaw) return yaw_alignment(sets);
    return space_alignment(sets, alignment == Alignment::sim3);
}

} // namespace locus::evaluate
