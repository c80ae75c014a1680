#include "fusion/uwb/chan.h"

#include "fusion/uwb/common_reference.h"
#include "fusion/uwb/normal_equations.h"

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>

namespace locus::uwb {
namespace {

template <int N>
using Vector = Eigen::Matrix<double, N, 1>;
template <int N>
using Matrix = Eigen::Matrix<double, N, N>;

/// A coordinate of this share of the largest is where its square stops telling its error.
constexpr double smallest_share = 1e-3;

template <int D>
Vector<D> away_from_zero(const Vector<D>& coordinates) {
    const double least = smallest_share * coordinates.cwiseAbs().maxCoeff() + 1e-9;
    return coordinates.cwiseAbs().cwiseMax(least).binaryExpr(coordinates,
                                                             [](double m, double v) { return std::copysign(m, v); });
}

/// Step two, eq. 6-7: step one measured the squares of the D coordinates and the sum of them. `sum_slope` is the
/// derivative of the sum by step one's last unknown. The signs are step one's.
template <int D>
Vector<D> second_step(const Vector<D>& first, double sum_of_squares, double sum_slope,
                      const Matrix<D + 1>& information) {
    Vector<D + 1> squares, inverse_slopes;
    squares << first.cwiseAbs2(), sum_of_squares;
    inverse_slopes << (2 * away_from_zero<D>(first)).cwiseInverse(), 1 / sum_slope;                       // 1 / 2B
    const Matrix<D + 1> weight = inverse_slopes.asDiagonal() * information * inverse_slopes.asDiagonal(); // 1 / Q'
    // G' is the identity above a row of ones: a product with it adds the last row, or column, to the others.
    const Eigen::Matrix<double, D, D + 1> weighted = weight.template topRows<D>().rowwise() + weight.row(D);
    const Matrix<D> normal = weighted.template leftCols<D>().colwise() + weighted.col(D);
    const Vector<D> result = normal.inverse() * (weighted * squares);      // eq. 6
    return result.cwiseMax(0).cwiseSqrt().cwiseProduct(first.cwiseSign()); // eq. 7
}

template <int D>
void add_point(ChanPoints& points, const Vector<D>& position) {
    Eigen::Vector3d point = Eigen::Vector3d::Zero();
    point.head<D>() = position;
    if (point.allFinite()) points.push_back(point);
}

/// D independent differences leave x = alpha - beta R1; |x|^2 + h^2 = R1^2 is a quadratic with up to two answers.
template <int D>
std::array<Vector<D>, 2> both_roots(const NormalEquations<D + 1>& normal, double height_m) {
    const Matrix<D> inverse = normal.information().template topLeftCorner<D, D>().inverse();
    const Vector<D> alpha = inverse * normal.projection().template head<D>();
    const Vector<D> beta = inverse * normal.information().template topRightCorner<D, 1>();
    const double a = beta.squaredNorm() - 1, b = -alpha.dot(beta), c = alpha.squaredNorm() + height_m * height_m;
    const double root = std::sqrt(std::max(0.0, b * b - a * c));
    const double stable = -(b + std::copysign(root, b)); // a R1^2 + 2 b R1 + c = 0 without cancellation
    return {Vector<D>(alpha - beta * (stable / a)), Vector<D>(alpha - beta * (c / stable))};
}

/// Step one, eq. 3-5, relative to the reference anchor. Every pair is a row, so the pairs' covariance is the rows' own.
template <int D>
NormalEquations<D + 1> first_step(const Epoch& epoch, const CommonReference& reference) {
    const Eigen::Vector3d origin = epoch.anchors_m.col(reference.anchor);
    const auto equation = [&](int anchor) {
        const Eigen::Vector3d place = epoch.anchors_m.col(anchor) - origin;
        const double difference = reference.difference_m(anchor);
        Vector<D + 2> e; // coordinates, R1, right side
        e << place.head<D>(), difference, 0.5 * (place.squaredNorm() - difference * difference);
        if constexpr (D == 2) e(D + 1) += place.z() * origin.z(); // the tag's height is known
        return e;
    };
    return sum_of_rows<D + 1>(epoch, [&](const Row& row) -> Vector<D + 2> {
        return row.inverse_sigma * (equation(row.b) - equation(row.a));
    });
}

/// Step one for ranges: r^2 = |x|^2 - 2 a.x + |a|^2, whose noise is 2 r times that of r.
template <int D>
NormalEquations<D + 1> first_step(const Epoch& epoch) {
    return sum_of_rows<D + 1>(epoch, [&](const Row& row) -> Vector<D + 2> {
        const Eigen::Vector3d anchor = epoch.anchors_m.col(row.b);
        const double slope = row.inverse_sigma / std::max(std::abs(2 * row.value_m), 1 / row.inverse_sigma);
        Vector<D + 2> e; // coordinates, |x|^2, right side
        e << 2 * anchor.head<D>(), -1, anchor.squaredNorm() - row.value_m * row.value_m;
        return slope * e;
    });
}

} // namespace

template <int D>
ChanPoints chan_differences(const Epoch& epoch) noexcept {
    ChanPoints points;
    const CommonReference reference = common_reference(epoch);
    if (!reference.connected) return points;
    const NormalEquations<D + 1> normal = first_step<D>(epoch, reference);
    const Eigen::Vector3d origin = epoch.anchors_m.col(reference.anchor);
    const Vector<D> shift = origin.head<D>();
    const double height_m = D == 2 ? origin.z() : 0;
    if (epoch.anchor_count() == D + 1) {
        for (const Vector<D>& root : both_roots<D>(normal, height_m)) add_point<D>(points, root + shift);
        return points;
    }
    const Vector<D + 1> first = normal.information().inverse() * normal.projection(); // eq. 5
    const double distance = std::max(std::abs(first(D)), 1e-6);
    const Vector<D> second = second_step<D>(first.template head<D>(), distance * distance - height_m * height_m,
                                            2 * distance, normal.information());
    add_point<D>(points, second + shift);
    return points;
}

template <int D>
ChanPoints chan_ranges(const Epoch& epoch) noexcept {
    const NormalEquations<D + 1> normal = first_step<D>(epoch);
    const Vector<D + 1> first = normal.information().inverse() * normal.projection();
    ChanPoints points;
    add_point<D>(points, second_step<D>(first.template head<D>(), first(D), 1, normal.information()));
    return points;
}

template ChanPoints chan_ranges<2>(const Epoch&) noexcept;
template ChanPoints chan_ranges<3>(const Epoch&) noexcept;
template ChanPoints chan_differences<2>(const Epoch&) noexcept;
template ChanPoints chan_differences<3>(const Epoch&) noexcept;

} // namespace locus::uwb
