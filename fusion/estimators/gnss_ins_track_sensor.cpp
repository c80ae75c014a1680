// What a vehicle's inertial sensor shows, its errors taken out: biases, and where they are estimated the scales of its
// six axes (Groves eq. 4.18 and 4.19 without the cross-coupling).
#include "fusion/estimators/gnss_ins_errors.h"
#include "fusion/estimators/gnss_ins_track.h"
#include "fusion/option.h"

namespace locus {

inertial::Rates GnssInsTrack::unbiased() const noexcept {
    inertial::Rates rates{imu_.rates().specific_force_mps2 - state.segment<3>(inertial::accelerometer_bias_at),
                          imu_.rates().angular_rate_radps - state.segment<3>(inertial::gyroscope_bias_at)};
    const int at = scales_at();
    if (at < 0) return rates;
    for (int axis = 0; axis < 3; ++axis) {
        rates.specific_force_mps2(axis) /= 1 + state(at + axis);
        rates.angular_rate_radps(axis) /= 1 + state(at + 3 + axis);
    }
    return rates;
}

/// They are the first wanderers after a start, and asked for too often to lose their places.
void GnssInsTrack::ask_for_scales() noexcept {
    if (model_.scale_sigma <= 0) return;
    for (int i = 0; i < 6; ++i) wanderer(sensor_scale_error - i, {model_.scale_sigma, no_limit});
}

/// A scale's error is one of the bias, as large as what the axis measures. So for one step the biases' errors may stand
/// for both: exact, since neither changes in the step.
void GnssInsTrack::put_scales_into_biases(const inertial::Rates& at, double sign) noexcept {
    const int scales = scales_at();
    if (scales < 0) return;
    const auto put = [&](int bias, int scale, double measured) {
        covariance.row(bias) += sign * measured * covariance.row(scale);
        covariance.col(bias) += sign * measured * covariance.col(scale);
    };
    for (int axis = 0; axis < 3; ++axis) {
        put(inertial::accelerometer_bias_at + axis, scales + axis, at.specific_force_mps2(axis));
        put(inertial::gyroscope_bias_at + axis, scales + 3 + axis, at.angular_rate_radps(axis));
    }
}

} // namespace locus
