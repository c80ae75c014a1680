// What can be set of the walkers' particle filter. Where the defaults come from:
// - the anchors' held error: as range_ekf_settings.h. A particle has no state for it; ranges of an anchor that come
//   faster than it changes count together as one. A range between two tags: as one to an anchor.
// - blocked paths: 1 in 10, longer by a metre: people block a tag with their own body; excess of 0.3 to 1.5 m (issue
// 4).
// - change of velocity 1 m/s in a second without an inertial unit: a walker who turns round within two seconds.
// - step noise, person's factor: inertial/step_length.h. Person's and device's heading part slowly: a pocket shifts.
// - at least 1,000 particles: within 1.05 of the posterior bound in position, and the heading is learnt well: after 20
// s
//   of steps alone simulated walkers were out by 0.6 m with 4,000, 1.0 m with 1,000, 1.4 m with 500, 1.9 m with 250.
// - Fox 2003: 0.05 with 99 %, as in the paper; resampling at half the count: customary (Arulampalam et al. 2002).
#pragma once

#include "fusion/estimators/reading_settings.h"

namespace locus {

struct WalkerParticlesSettings : ReadingSettings {
    double peer_range_sigma_m = 0.1;
    double anchor_error_sigma_m = 0.2;
    double anchor_error_time_s = 0.3;
    double blocked_share = 0.1;
    double blocked_excess_m = 1;
    double height_m = 1.2;
    double height_sigma_m = 0.2;
    double velocity_wander_mps_rts = 1;
    double speed_sigma_mps = 1;
    double person_sigma = 0.15;
    double step_sigma = 0.08;
    double course_wander_rad_rts = 0.03;
    bool use_imu = true;
    bool use_compass = true;
    int max_particles = 2000;
    int min_particles = 1000;
    int seed = 1;
    double gate_false_alarm = 1e-4;
    int gate_patience = 10;
    double start_window_s = 0.5;
    double lost_after_s = 1;
    double peer_horizon_s = 2;
};

inline constexpr std::array walker_only_options{
    option<&WalkerParticlesSettings::peer_range_sigma_m>("peer_range_sigma_m", "m", 0.001, 100,
                                                         "Noise of a range between two people's tags."),
    option<&WalkerParticlesSettings::anchor_error_sigma_m>(
        "anchor_error_sigma_m", "m", 0, 100,
        "Error of an anchor that stays while the pose hardly changes (antenna, body, multipath)."),
    option<&WalkerParticlesSettings::anchor_error_time_s>("anchor_error_time_s", "s", 0.01, 1e6,
                                                          "Time in which that error becomes another one."),
    option<&WalkerParticlesSettings::blocked_share>("blocked_share", "", 0.001, 0.9,
                                                    "Share of measurements whose path is blocked."),
    option<&WalkerParticlesSettings::blocked_excess_m>("blocked_excess_m", "m", 0.01, 100,
                                                       "By how much a blocked path is longer, about."),
    option<&WalkerParticlesSettings::height_m>("height_m", "m", -1e5, 1e5, "Height of the tag that a person wears."),
    option<&WalkerParticlesSettings::height_sigma_m>("height_sigma_m", "m", 0, 100,
                                                     "Standard deviation of that height."),
    option<&WalkerParticlesSettings::velocity_wander_mps_rts>(
        "velocity_wander_mps_rts", "m/s", 0.001, 100,
        "Change of each component of the velocity in a second, where no inertial unit is heard."),
    option<&WalkerParticlesSettings::speed_sigma_mps>("speed_sigma_mps", "m/s", 0.001, 100,
                                                      "Speed that a person may have when first heard."),
    option<&WalkerParticlesSettings::person_sigma>("person_sigma", "", 0.001, 1,
                                                   "Relative difference of people's steps that bounce alike."),
    option<&WalkerParticlesSettings::step_sigma>("step_sigma", "", 0.001, 1,
                                                 "Relative difference of one person's steps that bounce alike."),
    option<&WalkerParticlesSettings::course_wander_rad_rts>(
        "course_wander_rad_rts", "rad", 0, 10,
        "How far the way a person walks and the way the device points part in a second."),
    option<&WalkerParticlesSettings::use_imu>("use_imu", "Whether an inertial unit, where there is one, counts steps."),
    option<&WalkerParticlesSettings::use_compass>("use_compass",
                                                  "Whether its magnetometer, if it has one, holds the heading."),
    option<&WalkerParticlesSettings::max_particles>("max_particles", "", 16, 100000,
                                                    "Particles that memory is set aside for."),
    option<&WalkerParticlesSettings::min_particles>("min_particles", "", 16, 100000,
                                                    "Particles that are kept however sure the position is."),
    option<&WalkerParticlesSettings::seed>("seed", "", 1, 2147483647,
                                           "Of the random numbers: the same seed, the same poses."),
    option<&WalkerParticlesSettings::gate_false_alarm>("gate_false_alarm", "", 1e-12, 0.5,
                                                       "Chance that the gate refuses a good measurement."),
    option<&WalkerParticlesSettings::gate_patience>(
        "gate_patience", "", 0, 1000000, "Measurements of an anchor refused in a row before one is let in again."),
    option<&WalkerParticlesSettings::start_window_s>("start_window_s", "s", 0.01, 60,
                                                     "Age of the measurements that a first position is made from."),
    option<&WalkerParticlesSettings::lost_after_s>(
        "lost_after_s", "s", 0.01, 60, "How long most anchors are refused before the filter doubts itself."),
    option<&WalkerParticlesSettings::peer_horizon_s>(
        "peer_horizon_s", "s", 0, 60,
        "How far ahead a range to another person must promise a better position to be used."),
};

inline constexpr auto walker_particles_options = joined(reading_options<WalkerParticlesSettings>, walker_only_options);

} // namespace locus
