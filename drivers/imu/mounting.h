// What all inertial sensors have in common: which target carries them, how they are turned against its body, and the
// scale and bias of their axes. The body's axes: x forward, y left, z up.
#pragma once

#include "drivers/decoder.h"
#include "fusion/units.h"

namespace locus::imu {

struct MountingSettings {
    Address tag = no_address;
    Vec3 mounting_deg{0, 0, 0};
    Vec3 gyro_scale{1, 1, 1};
    Vec3 gyro_bias_dps{0, 0, 0};
    Vec3 accel_scale{1, 1, 1};
    Vec3 accel_bias_mps2{0, 0, 0};
};

/// The rows of a device's table whose settings derive from MountingSettings.
template <class Settings>
inline constexpr std::array mounting_options{
    option<&Settings::tag, Settings>("tag", "", -no_limit, no_limit, "Address of the target that carries it.", {},
                                     true),
    option<&Settings::mounting_deg, Settings>(
        "mounting_deg", "deg", -360, 360,
        "[roll, pitch, yaw] that turn the sensor's axes into the body's (x forward, y left, z up): first roll about x, "
        "then pitch about y, then yaw about z."),
    option<&Settings::gyro_scale, Settings>("gyro_scale", "", 0.5, 2,
                                            "Of each axis of the sensor: true rate = scale * (reading - bias)."),
    option<&Settings::gyro_bias_dps, Settings>("gyro_bias_dps", "deg/s", -50, 50,
                                               "What each axis of the sensor reads at rest."),
    option<&Settings::accel_scale, Settings>("accel_scale", "", 0.5, 2,
                                             "Of each axis of the sensor: true force = scale * (reading - bias)."),
    option<&Settings::accel_bias_mps2, Settings>("accel_bias_mps2", "m/s^2", -5, 5,
                                                 "What each axis of the sensor reads where there is no force."),
};

/// Readings in the sensor's axes: out_of_range, or a sample in the body's axes.
class Mounting {
  public:
    /// Twice what the widest of these sensors can measure (2000 deg/s, 16 g): more is a broken packet.
    static constexpr double largest_rate_radps = 4000 * rad_per_deg;
    static constexpr double largest_force_mps2 = 32 * standard_gravity_mps2;

    explicit Mounting(const MountingSettings& settings);

    void give(Timestamp time, const Vec3& force_sensor_mps2, const Vec3& rate_sensor_radps, MeasurementSink& sink,
              const Vec3f& field_sensor_ut = unknown_vec3f) const;
    /// Of the barometer beside it; what no place on the Earth has is out_of_range.
    void give_pressure(Timestamp time, double pressure_pa, MeasurementSink& sink) const;

  private:
    MountingSettings settings_;
    std::array<Vec3, 3> body_from_sensor_; ///< rows

    Vec3 in_body(const Vec3& sensor) const;
};

} // namespace locus::imu
