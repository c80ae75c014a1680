// What can be set of the particle filter on signal strength. Where the defaults come from:
// - a map is renewed every five minutes: working it out takes seconds of a core.
// - power at 1 m -50 dBm: what BLE and 802.15.4 radios at 0 dBm make of the free-space loss of the first metre (40 dB
//   at 2.4 GHz) and their antennas; 8 dB either way from device to device, until it is learnt. Exponent, shadowing:
//   Rappaport, tables 3.2 and 4.2.
// - tags hear each other as they hear beacons, 8 dB from tag to tag.
// - a scan each second: beacons send ten times to once a second.
// - held error 2 s: fading is another after a fraction of a wavelength, but a body shadows until it turns or has gone
//   on by a length or two of itself.
// - a beacon in reach is lost in a scan one time in ten, and one reading in twenty fits nothing: radios collide,
//   somebody stands right before the antenna.
// - no bodies: people and shelves that stood there in the survey too are in the map. On walks through a mall
// (accuracy.md)
//   allowing for others made places worse; in a crowd it makes them better by far (papers.md). What one takes: some 3
//   to 13 dB at 2.4 GHz.
// - feet: as federated_settings.h.
// - velocity: people walk at about 1 m/s and hold a direction for a few seconds; steps as walker_particles_settings.h.
#pragma once

#include "fusion/option.h"
#include "fusion/radio/grid_in_use.h"
#include "fusion/radio/radio_map.h"

#include <array>
#include <memory>
#include <string>

namespace locus {

struct RadioParticlesSettings {
    std::string map;
    std::string calibrated_map;
    double calibrate_every_s = 300;
    double power_1m_dbm = -50;
    double power_sigma_db = 8;
    double exponent = 2;
    double shadowing_db = 6;
    double reach_m = 20;
    double scan_s = 1;
    double lost_share = 0.1;
    double body_share = 0;
    double body_loss_db = 8;
    double outlier_share = 0.05;
    double peer_power_1m_dbm = -50;
    double peer_sigma_db = 8;
    double held_error_time_s = 2;
    double foot_error_sigma_m = 0.2;
    double foot_error_time_s = 1;
    double foot_patience_s = 0.5;
    double height_m = 1.2;
    double height_sigma_m = 0.2;
    double speed_sigma_mps = 0.7;
    double speed_time_s = 3;
    double person_sigma = 0.15;
    double step_sigma = 0.08;
    double course_wander_rad_rts = 0.03;
    bool use_imu = true;
    bool use_compass = true;
    int max_particles = 2000;
    int min_particles = 500;
    int seed = 1;
    double gate_false_alarm = 1e-4;

    /// What `map` names, read by config/radio_maps.h; null: the anchors and the path-loss model.
    std::shared_ptr<const radio::RadioMap> radio_map;
    /// Where `calibrated_map` is named: what `map` names, and `radio_map` is what has become of it.
    std::shared_ptr<const radio::RadioMap> surveyed_map;
    std::string calibration_note; ///< why what was taught before is not in it; empty: it is, or there is none
    /// What the estimators made of these settings read; null: each engine has its own.
    std::shared_ptr<radio::GridInUse> grid;
};

inline constexpr std::array radio_particles_options{
    option<&RadioParticlesSettings::map>(
        "map",
        "File of the radio map (docs/radio.md), beside this file if it is no whole path; left out: the path-loss "
        "model from the site's anchors."),
    option<&RadioParticlesSettings::calibrated_map>(
        "calibrated_map",
        "File in which the map is kept as those teach it whom cameras see, beside this file if it is no whole path; "
        "left out: the map stays as it was surveyed."),
    option<&RadioParticlesSettings::calibrate_every_s>("calibrate_every_s", "s", 1, 1e6,
                                                       "How often what was taught comes into use and is written down."),
    option<&RadioParticlesSettings::power_1m_dbm>(
        "power_1m_dbm", "dBm", -120, 30, "Without a map: strength at 1 m of a beacon that does not announce it."),
    option<&RadioParticlesSettings::power_sigma_db>("power_sigma_db", "dB", 0, 40,
                                                    "Standard deviation of that from beacon to beacon."),
    option<&RadioParticlesSettings::exponent>(
        "exponent", "", 0.5, 8, "Without a map: path-loss exponent; 2 in free space, 1.6 to 3.3 indoors."),
    option<&RadioParticlesSettings::shadowing_db>("shadowing_db", "dB", 0.5, 30,
                                                  "Without a map: deviation of a strength from the path-loss model."),
    option<&RadioParticlesSettings::reach_m>("reach_m", "m", 1, 1000,
                                             "Without a map: how far beyond the outermost anchors somebody may be."),
    option<&RadioParticlesSettings::scan_s>("scan_s", "s", 0.05, 60,
                                            "Time in which a receiver hears every beacon in reach at least once."),
    option<&RadioParticlesSettings::lost_share>(
        "lost_share", "", 0.001, 0.9,
        "Least chance that a beacon in reach is not heard in that time; a map with holes raises it."),
    option<&RadioParticlesSettings::body_share>(
        "body_share", "", 0, 0.9,
        "Chance that a body stands between radio and beacon which was not there in the survey."),
    option<&RadioParticlesSettings::body_loss_db>("body_loss_db", "dB", 0.5, 40, "What it takes, in the mean."),
    option<&RadioParticlesSettings::peer_power_1m_dbm>("peer_power_1m_dbm", "dBm", -120, 30,
                                                       "Strength at 1 m that one person's tag hears another's with."),
    option<&RadioParticlesSettings::peer_sigma_db>(
        "peer_sigma_db", "dB", 0.5, 40, "Deviation of that from the path-loss model: tags differ, bodies are near."),
    option<&RadioParticlesSettings::outlier_share>("outlier_share", "", 0.001, 0.9,
                                                   "Chance of a reading that fits neither map nor model."),
    option<&RadioParticlesSettings::held_error_time_s>(
        "held_error_time_s", "s", 0, 3600, "Time in which the deviation of a beacon's strength becomes another one."),
    option<&RadioParticlesSettings::foot_error_sigma_m>(
        "foot_error_sigma_m", "m", 0, 100,
        "How far the feet that a camera sees lie beside the radio, beyond the camera's own doubt."),
    option<&RadioParticlesSettings::foot_error_time_s>("foot_error_time_s", "s", 0, 1e6,
                                                       "Time in which a foot point's error becomes another one."),
    option<&RadioParticlesSettings::foot_patience_s>(
        "foot_patience_s", "s", 0, 60, "For how long foot points are refused before the cloud is put on the next."),
    option<&RadioParticlesSettings::height_m>("height_m", "m", -1e5, 1e5, "Height of the radio that a person carries."),
    option<&RadioParticlesSettings::height_sigma_m>("height_sigma_m", "m", 0, 100,
                                                    "Standard deviation of that height."),
    option<&RadioParticlesSettings::speed_sigma_mps>("speed_sigma_mps", "m/s", 0.01, 100,
                                                     "Speed along each axis, where no steps are counted."),
    option<&RadioParticlesSettings::speed_time_s>("speed_time_s", "s", 0.01, 3600,
                                                  "Time in which that becomes another one."),
    option<&RadioParticlesSettings::person_sigma>("person_sigma", "", 0.001, 1,
                                                  "Relative difference of people's steps that bounce alike."),
    option<&RadioParticlesSettings::step_sigma>("step_sigma", "", 0.001, 1,
                                                "Relative difference of one person's steps that bounce alike."),
    option<&RadioParticlesSettings::course_wander_rad_rts>(
        "course_wander_rad_rts", "rad", 0.001, 10,
        "How far the way a person walks and the way the device points part in a second."),
    option<&RadioParticlesSettings::use_imu>("use_imu", "Whether an inertial unit, where there is one, counts steps."),
    option<&RadioParticlesSettings::use_compass>("use_compass",
                                                 "Whether its magnetometer, if it has one, holds the heading."),
    option<&RadioParticlesSettings::max_particles>("max_particles", "", 16, 100000,
                                                   "Particles that memory is set aside for."),
    option<&RadioParticlesSettings::min_particles>("min_particles", "", 16, 100000,
                                                   "Particles that are kept however sure the position is."),
    option<&RadioParticlesSettings::seed>("seed", "", 1, 2147483647,
                                          "Of the random numbers: the same seed, the same poses."),
    option<&RadioParticlesSettings::gate_false_alarm>(
        "gate_false_alarm", "", 1e-12, 0.5,
        "How unlikely the cloud must be before it is put where the radios say; and chance that good feet are refused."),
};

} // namespace locus
