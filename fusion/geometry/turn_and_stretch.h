// Vectors of the plane as complex numbers: a product turns by the angle of one factor and stretches by its length.
#pragma once

#include <Eigen/Core>

namespace locus {

inline Eigen::Vector2d product(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return {a.x() * b.x() - a.y() * b.y(), a.x() * b.y() + a.y() * b.x()};
}

inline Eigen::Vector2d quotient(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return product(a, {b.x(), -b.y()}) / b.squaredNorm();
}

/// product_matrix(a) b = product(a, b)
inline Eigen::Matrix2d product_matrix(const Eigen::Vector2d& a) {
    return (Eigen::Matrix2d() << a.x(), -a.y(), a.y(), a.x()).finished();
}

} // namespace locus
