// Kalman update by one scalar observation in Joseph's form. One scalar at a time needs no matrix inverse; Joseph's form
// stays right for any gain, and P is written symmetric by construction: filters that let the two halves of P drift
// apart diverge within 10^6 steps.
#pragma once

#include "fusion/filter/robust_gain.h"

#include <Eigen/Core>

namespace locus::filter {

/// What the state expects of a scalar observation.
template <class Vector>
struct Prediction {
    Vector cross;              ///< P h: covariance of the state with the predicted observation
    double state_variance = 0; ///< h' P h: how unsure the prediction is because the state is
};

template <class Vector, class Matrix>
Prediction<Vector> predict_scalar(const Matrix& covariance, const Vector& jacobian) {
    Prediction<Vector> prediction;
    prediction.cross = Vector::Zero(jacobian.size());
    for (Eigen::Index i = 0; i < jacobian.size(); ++i) // most of an observation's jacobian is zero
        if (jacobian(i) != 0) prediction.cross += jacobian(i) * covariance.col(i);
    prediction.state_variance = jacobian.dot(prediction.cross);
    return prediction;
}

/// P <- (I - K h')P(I - K h')' + K R K' for any gain K, with c = P h and s = h'Ph.
template <class Vector, class Matrix>
void joseph(Matrix& covariance, const Vector& gain, const Prediction<Vector>& prediction, double variance) {
    // Product by product this is (I - K h')P(I - K h')' + K R K' = P - K u' - u K' with u as here. An entry and its
    // mirror image are the same two products in another order: what was symmetric to the bit stays so, as long as no
    // compiler fuses a product with the sum (-ffp-contract=off). Plain loops: half the time of Eigen's columns here.
    const Vector rest = prediction.cross - 0.5 * (prediction.state_variance + variance) * gain;
    const Eigen::Index size = gain.size();
    const double *const u = rest.data(), *const k = gain.data();
    for (Eigen::Index j = 0; j < size; ++j) {
        double* const column = covariance.col(j).data();
        const double uj = u[j], kj = k[j];
        for (Eigen::Index i = 0; i < size; ++i) column[i] -= uj * k[i] + kj * u[i];
    }
}

/// Takes in `share` of one observation with innovation `innovation` and variance `variance` > 0 (paper 001 eq. 9-11).
/// In the covariance, a part of the credit is Kalman's update with as much more noise.
template <class Vector, class Matrix>
void update_scalar(Vector& state, Matrix& covariance, const Prediction<Vector>& prediction, double innovation,
                   double variance, const Share& share = {}) {
    const double innovation_variance = prediction.state_variance + variance;
    state += prediction.cross * (share.step * innovation / innovation_variance);
    const double weakened = innovation_variance / share.credit;
    const Vector gain = prediction.cross / weakened;
    joseph(covariance, gain, prediction, weakened - prediction.state_variance);
}

} // namespace locus::filter
