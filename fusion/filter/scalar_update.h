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
    prediction.cross.noalias() = covariance * jacobian;
    prediction.state_variance = jacobian.dot(prediction.cross);
    return prediction;
}

/// P <- (I - K h')P(I - K h')' + K R K' for any gain K, with c = P h and s = h'Ph.
template <class Vector, class Matrix>
void joseph(Matrix& covariance, const Vector& gain, const Prediction<Vector>& prediction, double variance) {
    const double innovation_variance = prediction.state_variance + variance;
    // Product by product this is (I - K h')P(I - K h')' + K R K': the bracket is the part of P h that K leaves over.
    const Vector rest = prediction.cross - innovation_variance * gain;
    covariance.noalias() -= gain * prediction.cross.transpose();
    covariance.noalias() -= rest * gain.transpose();
    covariance.template triangularView<Eigen::StrictlyLower>() = covariance.transpose();
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
