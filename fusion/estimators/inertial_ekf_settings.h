// What can be set of the default estimator beyond the range filter's settings. Where the defaults come from:
// - accelerometer 0.1 m/s^2/sqrt(Hz), gyroscope 0.003 rad/s/sqrt(Hz): twenty times the data sheets of phone-class MEMS
//   (BMI088: 0.0019 and 0.00024), because what a sensor on a person or a drone adds is vibration that its sampling
//   folds down and clipping. Against motion capture the sound flights of util_uwb_tdoa show 0.1-0.2 m/s^2 that last
//   about half a second, which is 0.1. Halving or doubling either changes errors on recordings by less than a tenth.
// - biases 0.3 m/s^2 and 0.01 rad/s: zero-g offset and zero-rate offset over temperature after the maker's calibration
//   (30 mg, 0.6 deg/s); walks: they may change by a tenth of that in ten minutes, and by warming up.
// - aligning 0.25 m/s^2/sqrt(Hz): two and a half degrees of tilt (0.4 m/s^2) that last a third of a second.
// - a second model of motion, 0.5 m/s^2 that last a second, kept to for 5 s: walking or driving evenly, without corners
//   and stops; speeds then wander by half a metre per second in a second. 0.5 or 1 m/s^2 and 1 or 5 s are the same
//   within 3 % on recordings.
// - a height sensor 0.05 m and 0.1 m for 5 s: a laser's data sheet (VL53L1X: 20 mm and its tilt), and floors that
//   are not flat: thresholds, boxes, pallets.
// - feet that a camera sees: 0.2 m for 1 s. A tag is worn up to that far beside the middle of the feet and turns with
//   its wearer, and a stride, which moves the lower edge of his box, takes a second.
// - a tag 1.0 m above the floor, 0.3 m of doubt: between the hip and the chest of people from 1.5 to 2 m; it stays
// worn.
#pragma once

#include "fusion/estimators/range_ekf_settings.h"

namespace locus {

struct InertialEkfSettings : RangeEkfSettings {
    bool use_imu = true;
    Vec3 antenna_body_m{0, 0, 0};
    double acceleration_noise_mps2_rthz = 0.1;
    double angular_rate_noise_radps_rthz = 0.003;
    double acceleration_bias_sigma_mps2 = 0.3;
    double acceleration_bias_walk_mps2_rts = 0.01;
    double angular_rate_bias_sigma_radps = 0.01;
    double angular_rate_bias_walk_radps_rts = 0.0005;
    double aligning_noise_mps2_rthz = 0.25;
    bool zero_velocity = true;
    bool foot_mounted = false;
    double dead_reckoning_s = 10;
    double steady_acceleration_sigma_mps2 = 0.5;
    double steady_acceleration_time_s = 1;
    double steady_for_s = 5;
    double height_sigma_m = 0.05;
    double height_error_sigma_m = 0.1;
    double height_error_time_s = 5;
    double height_offset_m = 0;
    double speed_sigma_of_wheel_mps = 0.2;
    double foot_error_sigma_m = 0.2;
    double foot_error_time_s = 1;
    double tag_height_m = 1;
    double tag_height_sigma_m = 0.3;
    double tag_height_time_s = 60;
};

template <class Settings>
inline constexpr std::array inertial_only_options{
    option<&InertialEkfSettings::use_imu, Settings>("use_imu", "Whether samples of an inertial sensor are used."),
    option<&InertialEkfSettings::antenna_body_m, Settings>(
        "antenna_body_m", "m", -100, 100,
        "From the inertial sensor to the tag's antenna, along the sensor's axes: [x, y, z]."),
    option<&InertialEkfSettings::acceleration_noise_mps2_rthz, Settings>(
        "acceleration_noise_mps2_rthz", "m/s^2/sqrt(Hz)", 1e-6, 100,
        "Density of the accelerometer's noise where it is mounted, vibration included."),
    option<&InertialEkfSettings::angular_rate_noise_radps_rthz, Settings>(
        "angular_rate_noise_radps_rthz", "rad/s/sqrt(Hz)", 1e-8, 10,
        "Density of the gyroscope's noise where it is mounted, vibration included."),
    option<&InertialEkfSettings::acceleration_bias_sigma_mps2, Settings>(
        "acceleration_bias_sigma_mps2", "m/s^2", 0, 20, "Bias that the accelerometer may have at the start."),
    option<&InertialEkfSettings::acceleration_bias_walk_mps2_rts, Settings>(
        "acceleration_bias_walk_mps2_rts", "m/s^2/sqrt(s)", 0, 20, "How much that bias changes with time."),
    option<&InertialEkfSettings::angular_rate_bias_sigma_radps, Settings>(
        "angular_rate_bias_sigma_radps", "rad/s", 0, 1, "Bias that the gyroscope may have at the start."),
    option<&InertialEkfSettings::angular_rate_bias_walk_radps_rts, Settings>(
        "angular_rate_bias_walk_radps_rts", "rad/s/sqrt(s)", 0, 1, "How much that bias changes with time."),
    option<&InertialEkfSettings::aligning_noise_mps2_rthz, Settings>(
        "aligning_noise_mps2_rthz", "m/s^2/sqrt(Hz)", 0.01, 100,
        "Noise of the acceleration while the sensor's heading is being found; tilt errors included."),
    option<&InertialEkfSettings::zero_velocity, Settings>(
        "zero_velocity", "Whether a sensor that lies still means that the target stands; not for lifts."),
    option<&InertialEkfSettings::foot_mounted, Settings>(
        "foot_mounted", "Whether the sensor is worn on a foot, which stands still in every step (zero_velocity too)."),
    option<&InertialEkfSettings::dead_reckoning_s, Settings>(
        "dead_reckoning_s", "s", 0, 3600, "How long the inertial sensor alone carries a pose, without any range."),
    option<&InertialEkfSettings::steady_acceleration_sigma_mps2, Settings>(
        "steady_acceleration_sigma_mps2", "m/s^2", 0, 1000,
        "Acceleration of a target that moves steadily or stands, a second model beside the first; 0: none."),
    option<&InertialEkfSettings::steady_acceleration_time_s, Settings>("steady_acceleration_time_s", "s", 0.01, 1e4,
                                                                       "Time in which such an acceleration dies away."),
    option<&InertialEkfSettings::steady_for_s, Settings>(
        "steady_for_s", "s", 0.01, 1e6, "How long a target keeps to one of the two models on average."),
    option<&InertialEkfSettings::height_sigma_m, Settings>("height_sigma_m", "m", 0.001, 100,
                                                           "Noise of a height whose device states none."),
    option<&InertialEkfSettings::height_error_sigma_m, Settings>(
        "height_error_sigma_m", "m", 0, 100, "Error of a height that stays for a while (the floor is not flat)."),
    option<&InertialEkfSettings::height_error_time_s, Settings>("height_error_time_s", "s", 0.01, 1e6,
                                                                "Time in which that error becomes another one."),
    option<&InertialEkfSettings::height_offset_m, Settings>(
        "height_offset_m", "m", -100, 100, "What the height sensor tells less the height of the antenna."),
    option<&InertialEkfSettings::speed_sigma_of_wheel_mps, Settings>(
        "speed_sigma_of_wheel_mps", "m/s", 0.001, 100, "Noise of a wheel speed whose device states none."),
    option<&InertialEkfSettings::foot_error_sigma_m, Settings>(
        "foot_error_sigma_m", "m", 0, 100,
        "How far the feet that a camera sees lie beside the tag for a while, beyond the camera's own doubt."),
    option<&InertialEkfSettings::foot_error_time_s, Settings>("foot_error_time_s", "s", 0.01, 1e6,
                                                              "Time in which that error becomes another one."),
    option<&InertialEkfSettings::tag_height_m, Settings>(
        "tag_height_m", "m", -100, 100, "Height above the floor at which whom a camera sees wears his tag."),
    option<&InertialEkfSettings::tag_height_sigma_m, Settings>("tag_height_sigma_m", "m", 0, 100,
                                                               "Doubt in that height; 0: a camera says nothing of it."),
    option<&InertialEkfSettings::tag_height_time_s, Settings>(
        "tag_height_time_s", "s", 0.01, 1e6, "Time in which it becomes another one (the tag is taken in hand)."),
};

/// `Settings`: those of an estimator that has InertialEkfSettings as a base.
template <class Settings>
inline constexpr auto inertial_options = joined(range_options<Settings>, inertial_only_options<Settings>);

} // namespace locus
