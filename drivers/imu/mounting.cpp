// From the axes of a sensor to those of the body that carries it.
#include "drivers/imu/mounting.h"

#include <algorithm>
#include <cmath>

namespace locus::imu {
namespace {

/// Rz(yaw) Ry(pitch) Rx(roll); e.g. Titterton, Weston, "Strapdown Inertial Navigation Technology", 2nd ed., sec. 3.6.
std::array<Vec3, 3> rotation(const Vec3& roll_pitch_yaw_deg) {
    const auto [roll, pitch, yaw] = roll_pitch_yaw_deg;
    const double sr = std::sin(roll * rad_per_deg), cr = std::cos(roll * rad_per_deg);
    const double sp = std::sin(pitch * rad_per_deg), cp = std::cos(pitch * rad_per_deg);
    const double sy = std::sin(yaw * rad_per_deg), cy = std::cos(yaw * rad_per_deg);
    return {{{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
             {sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr},
             {-sp, cp * sr, cp * cr}}};
}

Vec3 calibrated(const Vec3& reading, const Vec3& scale, const Vec3& bias, double bias_unit) {
    Vec3 result{};
    for (std::size_t i = 0; i < 3; ++i) result[i] = scale[i] * (reading[i] - bias_unit * bias[i]);
    return result;
}

/// False also for what is not a number.
bool within(const Vec3& reading, double largest) {
    return std::ranges::all_of(reading, [=](double value) { return std::abs(value) <= largest; });
}

} // namespace

Mounting::Mounting(const MountingSettings& settings)
    : settings_(settings), body_from_sensor_(rotation(settings.mounting_deg)) {}

Vec3 Mounting::in_body(const Vec3& sensor) const {
    Vec3 body{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) body[i] += body_from_sensor_[i][j] * sensor[j];
    return body;
}

void Mounting::give(Timestamp time, const Vec3& force_sensor_mps2, const Vec3& rate_sensor_radps, MeasurementSink& sink,
                    const Vec3f& field_sensor_ut) const {
    if (!within(force_sensor_mps2, largest_force_mps2) || !within(rate_sensor_radps, largest_rate_radps))
        return sink.refuse(Refusal::out_of_range);
    ImuSample sample;
    sample.tag = settings_.tag;
    sample.specific_force_mps2 =
        in_body(calibrated(force_sensor_mps2, settings_.accel_scale, settings_.accel_bias_mps2, 1));
    sample.angular_rate_radps =
        in_body(calibrated(rate_sensor_radps, settings_.gyro_scale, settings_.gyro_bias_dps, rad_per_deg));
    const Vec3 field = in_body({field_sensor_ut[0], field_sensor_ut[1], field_sensor_ut[2]});
    if (within(field, 1e6)) // a magnet at its side; otherwise it stays unknown
        std::ranges::transform(field, sample.magnetic_field_ut.begin(), [](double v) { return static_cast<float>(v); });
    sink.accept(time, sample);
}

void Mounting::give_pressure(Timestamp time, double pressure_pa, MeasurementSink& sink) const {
    // The Everest has 31 kPa, the Dead Sea 107 kPa.
    if (!(pressure_pa >= 20e3 && pressure_pa <= 120e3)) return sink.refuse(Refusal::out_of_range);
    Pressure pressure;
    pressure.tag = settings_.tag;
    pressure.pressure_pa = pressure_pa;
    sink.accept(time, pressure);
}

} // namespace locus::imu
