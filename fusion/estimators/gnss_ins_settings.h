// What can be set of the vehicles' estimator. Where the defaults come from:
// - inertial sensor: industrial MEMS on a running engine. Data sheets (ADIS16470, BMI088, Epson G370) say 0.0004 to
//   0.002 m/s^2/sqrt(Hz) and 2e-5 to 2.5e-4 rad/s/sqrt(Hz); an idling car showed 0.004 and 1.4e-4 at a standstill,
//   and driving adds a few times that. Biases over temperature 30 mg and 0.6 deg/s; they walk by a tenth of that in an
//   hour. Scales: data sheets of MEMS units allow from 0.5 to 3 % (MPU-6000: 3 %).
// - satellites: code of a multi-band receiver 0.3 m at the zenith and Doppler 0.05 m/s (u-blox F9P data sheet: 1.5 m
//   CEP, 0.05 m/s), divided by the sine of the elevation and times 10^((45 dBHz - C/N0) / 20), as noise in a
//   correlator goes. What the atmosphere and reflections leave, 1.5 m that stays for a minute, is the user range error
//   of single-frequency code (GPS SPS performance standard: 0.6-2 m, and urban code multipath).
// - carrier: noise and reflections 3 mm at the zenith (rtklib's manual 2.4.2, E.6.24: a hundredth of the code's),
// divided
//   like those. What orbit, clock and air drift from one epoch to the next: 3 mm/s (GPS SPS performance standard 2020,
//   table 3.4-2: user range rate error 6 mm/s, 95 %).
// - receiver clock: TCXO (Groves 2013, section 9.4.2: 0.04 m^2/s^3).
// - two antennas: u-blox ZED-F9P data sheet, 0.4 deg with antennas 1 m apart. Reflections move a fixed carrier's
//   antenna by some 5 mm for as long as the geometry is the same, a minute: 0.3 deg of a metre. Brackets that were
//   laid out by eye are off by a degree.
// - wheels: a speed that may be off by a twentieth (tyres); side slip and the road's unevenness 0.2 m/s.
// - barometer: 1 hPa of weather in an hour is 8 m; gusts and vents 1 m.
#pragma once

#include "fusion/option.h"

#include <array>

namespace locus {

struct GnssInsSettings {
    std::string coupling = "auto";
    bool use_imu = true;
    Vec3 mounting_deg{0, 0, 0};
    Vec3 gnss_antenna_body_m{0, 0, 0};
    Vec3 tag_body_m{0, 0, 0};
    double acceleration_noise_mps2_rthz = 0.02;
    double angular_rate_noise_radps_rthz = 3e-4;
    double acceleration_bias_sigma_mps2 = 0.3;
    double acceleration_bias_walk_mps2_rts = 5e-4;
    double angular_rate_bias_sigma_radps = 0.01;
    double angular_rate_bias_walk_radps_rts = 2e-5;
    bool estimate_scale = false;
    double scale_sigma = 0.01;
    double unaided_acceleration_mps2_rthz = 2;
    double align_speed_mps = 4;
    double align_heading_sigma_deg = 5;

    double code_sigma_m = 0.3;
    double rate_sigma_mps = 0.05;
    bool use_carrier = true;
    double carrier_sigma_m = 0.003;
    double carrier_drift_sigma_mps = 0.003;
    double satellite_error_sigma_m = 1.5;
    double satellite_error_time_s = 60;
    double least_elevation_deg = 10;
    double least_carrier_to_noise_dbhz = 25;
    double clock_phase_m_rts = 0.1;
    double clock_drift_mps_rts = 0.2;
    double fix_sigma_m = 2;
    double fix_speed_sigma_mps = 0.1;
    double fix_error_sigma_m = 2;
    double fix_error_time_s = 60;
    bool adaptive_noise = false;
    double gate_false_alarm = 1e-3;
    int gate_patience = 25;
    double robust_scale = 2;

    bool use_wheel_speed = true;
    double wheel_speed_sigma_mps = 0.3;
    double wheel_scale_sigma = 0.05;
    double yaw_rate_sigma_radps = 0.02;
    bool non_holonomic = true;
    double slip_sigma_mps = 0.2;
    double mounting_sigma_deg = 2;
    Vec3 axle_body_m{0, 0, 0};
    bool zero_velocity = true;
    bool use_pressure = true;
    double pressure_height_sigma_m = 1;
    double pressure_error_sigma_m = 10;
    double pressure_error_time_s = 3600;
    double refuse_fix_height_m = 0;

    bool use_heading = true;
    double heading_mounting_deg = 0;
    double heading_mounting_sigma_deg = 1;
    double heading_baseline_m = 0;
    double heading_sigma_deg = 0.5;
    double heading_error_sigma_deg = 0.3;
    double heading_error_time_s = 60;

    double range_sigma_m = 0.1;
    double range_error_sigma_m = 0.2;
    double range_error_time_s = 0.3;
    double dead_reckoning_s = 120;
};

inline constexpr std::array<std::string_view, 4> couplings{"auto", "tight", "loose", "both"};

inline constexpr std::array gnss_ins_options{
    option<&GnssInsSettings::coupling>("coupling",
                                       "What of GNSS is used: tight (ranges and rates of each satellite), loose (the "
                                       "receiver's fixes), both, or auto: "
                                       "fixes only while there are no satellite ranges.",
                                       couplings),
    option<&GnssInsSettings::use_imu>("use_imu", "Whether samples of an inertial sensor are used."),
    option<&GnssInsSettings::mounting_deg>(
        "mounting_deg", "deg", -360, 360,
        "How the sensor is mounted in the vehicle (x forward, y left, z up): [roll, pitch, yaw], turned in the order "
        "yaw, pitch, roll from the vehicle's axes to the sensor's. All that follows is in the vehicle's axes."),
    option<&GnssInsSettings::gnss_antenna_body_m>("gnss_antenna_body_m", "m", -100, 100,
                                                  "From the inertial sensor to the GNSS antenna."),
    option<&GnssInsSettings::tag_body_m>("tag_body_m", "m", -100, 100, "From the inertial sensor to the UWB tag."),
    option<&GnssInsSettings::acceleration_noise_mps2_rthz>("acceleration_noise_mps2_rthz", "m/s^2/sqrt(Hz)", 1e-6, 100,
                                                           "Density of the accelerometer's noise, vibration included."),
    option<&GnssInsSettings::angular_rate_noise_radps_rthz>("angular_rate_noise_radps_rthz", "rad/s/sqrt(Hz)", 1e-8, 10,
                                                            "Density of the gyroscope's noise, vibration included."),
    option<&GnssInsSettings::acceleration_bias_sigma_mps2>("acceleration_bias_sigma_mps2", "m/s^2", 0, 20,
                                                           "Bias that the accelerometer may have at the start."),
    option<&GnssInsSettings::acceleration_bias_walk_mps2_rts>("acceleration_bias_walk_mps2_rts", "m/s^2/sqrt(s)", 0, 20,
                                                              "How much that bias changes with time."),
    option<&GnssInsSettings::angular_rate_bias_sigma_radps>("angular_rate_bias_sigma_radps", "rad/s", 0, 1,
                                                            "Bias that the gyroscope may have at the start."),
    option<&GnssInsSettings::angular_rate_bias_walk_radps_rts>("angular_rate_bias_walk_radps_rts", "rad/s/sqrt(s)", 0,
                                                               1, "How much that bias changes with time."),
    option<&GnssInsSettings::estimate_scale>(
        "estimate_scale", "Whether the scales of the inertial sensor's six axes are estimated beside its biases."),
    option<&GnssInsSettings::scale_sigma>("scale_sigma", "", 1e-6, 0.5, "How far from 1 those scales may be."),
    option<&GnssInsSettings::unaided_acceleration_mps2_rthz>(
        "unaided_acceleration_mps2_rthz", "m/s^2/sqrt(Hz)", 0.01, 100,
        "How the vehicle accelerates, as noise, while no aligned inertial sensor tells."),
    option<&GnssInsSettings::align_speed_mps>(
        "align_speed_mps", "m/s", 0.5, 100,
        "At this speed the course gives the first heading; vehicles drive forward by then."),
    option<&GnssInsSettings::align_heading_sigma_deg>("align_heading_sigma_deg", "deg", 0.1, 90,
                                                      "How far the heading may be from the course then."),
    option<&GnssInsSettings::code_sigma_m>("code_sigma_m", "m", 0.001, 100,
                                           "Noise of a pseudorange at the zenith whose device states none."),
    option<&GnssInsSettings::rate_sigma_mps>("rate_sigma_mps", "m/s", 0.001, 100,
                                             "Noise of a range rate at the zenith whose device states none."),
    option<&GnssInsSettings::use_carrier>(
        "use_carrier", "Whether the change of a satellite's carrier phase since its epoch before is used."),
    option<&GnssInsSettings::carrier_sigma_m>("carrier_sigma_m", "m", 1e-4, 1,
                                              "Noise of a carrier phase at the zenith, reflections included."),
    option<&GnssInsSettings::carrier_drift_sigma_mps>(
        "carrier_drift_sigma_mps", "m/s", 0, 1,
        "By which orbit, satellite's clock and air change between two epochs, at the zenith."),
    option<&GnssInsSettings::satellite_error_sigma_m>(
        "satellite_error_sigma_m", "m", 0, 100,
        "Error of a satellite's pseudorange that stays for a while (atmosphere, orbit, reflections), at the zenith."),
    option<&GnssInsSettings::satellite_error_time_s>("satellite_error_time_s", "s", 0.01, 1e6,
                                                     "Time in which that error becomes another one."),
    option<&GnssInsSettings::least_elevation_deg>("least_elevation_deg", "deg", 0, 90,
                                                  "Satellites lower than this are not used."),
    option<&GnssInsSettings::least_carrier_to_noise_dbhz>("least_carrier_to_noise_dbhz", "dBHz", 0, 60,
                                                          "Signals weaker than this are not used."),
    option<&GnssInsSettings::clock_phase_m_rts>("clock_phase_m_rts", "m/sqrt(s)", 0, 1e3,
                                                "Random walk of the receiver's clock."),
    option<&GnssInsSettings::clock_drift_mps_rts>("clock_drift_mps_rts", "m/s/sqrt(s)", 1e-6, 1e3,
                                                  "Random walk of the receiver clock's drift."),
    option<&GnssInsSettings::fix_sigma_m>("fix_sigma_m", "m", 0.001, 1000, "Noise of a fix whose device states none."),
    option<&GnssInsSettings::fix_speed_sigma_mps>("fix_speed_sigma_mps", "m/s", 0.001, 100,
                                                  "Noise of a fix's velocity whose device states none."),
    option<&GnssInsSettings::fix_error_sigma_m>("fix_error_sigma_m", "m", 0, 100,
                                                "Error of fixes that stays for a while, of each axis."),
    option<&GnssInsSettings::fix_error_time_s>("fix_error_time_s", "s", 0.01, 1e6,
                                               "Time in which that error becomes another one."),
    option<&GnssInsSettings::adaptive_noise>(
        "adaptive_noise", "Whether the noise of satellites and fixes is learnt from the innovations (IAE)."),
    option<&GnssInsSettings::gate_false_alarm>("gate_false_alarm", "", 1e-12, 0.5,
                                               "Chance that a good observation is refused."),
    option<&GnssInsSettings::gate_patience>("gate_patience", "", 1, 100000,
                                            "After so many refusals in a row a source is given one chance."),
    option<&GnssInsSettings::robust_scale>(
        "robust_scale", "", 0.1, 1e6, "At how many standard deviations of its innovations an observation counts half."),
    option<&GnssInsSettings::use_wheel_speed>("use_wheel_speed", "Whether wheel speeds and yaw rates are used."),
    option<&GnssInsSettings::wheel_speed_sigma_mps>("wheel_speed_sigma_mps", "m/s", 0.001, 100,
                                                    "Noise of a wheel speed whose device states none."),
    option<&GnssInsSettings::wheel_scale_sigma>(
        "wheel_scale_sigma", "", 0, 1, "How far from 1 the scale of the wheel speed may be; it is found on the way."),
    option<&GnssInsSettings::yaw_rate_sigma_radps>("yaw_rate_sigma_radps", "rad/s", 1e-5, 10,
                                                   "Noise of the yaw rate that comes with a wheel speed."),
    option<&GnssInsSettings::non_holonomic>("non_holonomic", "Whether the vehicle moves only where its wheels point."),
    option<&GnssInsSettings::slip_sigma_mps>("slip_sigma_mps", "m/s", 0.001, 100,
                                             "Sideways and upward speed that the axle has all the same."),
    option<&GnssInsSettings::mounting_sigma_deg>("mounting_sigma_deg", "deg", 0, 45,
                                                 "How far mounting_deg may be off in pitch and yaw; found on the way."),
    option<&GnssInsSettings::axle_body_m>("axle_body_m", "m", -100, 100,
                                          "From the inertial sensor to the middle of the axle that does not steer."),
    option<&GnssInsSettings::zero_velocity>(
        "zero_velocity", "Whether a sensor that lies still means that the vehicle stands; not for ferries."),
    option<&GnssInsSettings::use_pressure>("use_pressure", "Whether a barometer is used for the height."),
    option<&GnssInsSettings::pressure_height_sigma_m>("pressure_height_sigma_m", "m", 0.01, 1000,
                                                      "Noise of a barometer's height: gusts, vents."),
    option<&GnssInsSettings::pressure_error_sigma_m>("pressure_error_sigma_m", "m", 0, 1000,
                                                     "How far the weather moves a barometer's height."),
    option<&GnssInsSettings::pressure_error_time_s>("pressure_error_time_s", "s", 1, 1e6, "Time in which it does so."),
    option<&GnssInsSettings::refuse_fix_height_m>(
        "refuse_fix_height_m", "m", 0, 1000,
        "Fixes whose height is off by this from the barometer's are refused (paper 002: 6); 0: none."),
    option<&GnssInsSettings::use_heading>("use_heading", "Whether the heading of two GNSS antennas is used."),
    option<&GnssInsSettings::heading_mounting_deg>("heading_mounting_deg", "deg", -360, 360,
                                                   "Where the second antenna lies, seen from the first: 0 ahead, 90 "
                                                   "left, 180 behind. 0 too where the receiver has "
                                                   "been told already."),
    option<&GnssInsSettings::heading_mounting_sigma_deg>("heading_mounting_sigma_deg", "deg", 0, 45,
                                                         "How far that may be off; found on the way."),
    option<&GnssInsSettings::heading_baseline_m>(
        "heading_baseline_m", "m", 0, 100,
        "Distance of the two antennas: headings whose own differs by over 0.05 m are refused; 0: none."),
    option<&GnssInsSettings::heading_sigma_deg>("heading_sigma_deg", "deg", 0.001, 90,
                                                "Noise of a heading whose device states none."),
    option<&GnssInsSettings::heading_error_sigma_deg>("heading_error_sigma_deg", "deg", 0, 90,
                                                      "Error of headings that stays for a while."),
    option<&GnssInsSettings::heading_error_time_s>("heading_error_time_s", "s", 0.01, 1e6,
                                                   "Time in which that error becomes another one."),
    option<&GnssInsSettings::range_sigma_m>("range_sigma_m", "m", 0.001, 100,
                                            "Noise of a UWB range whose device and anchor state none."),
    option<&GnssInsSettings::range_error_sigma_m>("range_error_sigma_m", "m", 0, 100,
                                                  "Error of an anchor's ranges that stays for a while."),
    option<&GnssInsSettings::range_error_time_s>("range_error_time_s", "s", 0.01, 1e6,
                                                 "Time in which that error becomes another one."),
    option<&GnssInsSettings::dead_reckoning_s>(
        "dead_reckoning_s", "s", 0, 3600, "How long the vehicle's own sensors carry a pose without GNSS and ranges."),
};

} // namespace locus
