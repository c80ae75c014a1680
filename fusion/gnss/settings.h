// What is taken of raw GNSS observations, and how far they are believed. Where the defaults come from:
// - orbit_sigma_m: GPS SPS Performance Standard (2020), table 3.4-1: error of the signal in space 2.0 m, 95 %.
// - code_sigma_m: rtklib's manual 2.4.2, E.6.24: 0.3 m, once and once more over the sine of the elevation.
// - noise_at_0_dbhz_m: Kuusniemi, User-level reliability and quality monitoring in satellite-based personal navigation
//   (2005): variance of a code 150^2 m^2 10^(-C/N0 / 10) under open sky: 0.8 m at 45 dBHz, 4.7 m at 30 dBHz.
// - rate_sigma_mps: data sheets of u-blox (M8, F9): velocity to 0.05 m/s.
// - max_ephemeris_age_s: Galileo OS Service Definition: 4 hours from toe, the longest of all.
// - max_correction_age_s: rtklib's manual 2.4.2, E.7.4: age of differential 30 s.
// - ionosphere_gradient_mpkm: Lee and others, Assessment of nominal ionosphere spatial decorrelation for LAAS, IEEE
// PLANS
//   2006: 4 mm/km at the zenith bounds days without storm.
// - false_alarm: as is usual for receiver autonomous integrity monitoring.
#pragma once

#include "fusion/option.h"

#include <array>
#include <string>

namespace locus {

struct GnssSettings {
    double elevation_mask_deg = 10;
    double min_carrier_to_noise_dbhz = 20;
    double max_ephemeris_age_s = 14400;
    double max_glonass_age_s = 1800;
    double orbit_sigma_m = 1;
    double code_sigma_m = 0.3;
    double noise_at_0_dbhz_m = 150;
    double rate_sigma_mps = 0.05;
    double max_correction_age_s = 30;
    double ionosphere_gradient_mpkm = 0.004;
    double false_alarm = 1e-3;
    double gather_s = 0.02;
    int max_receivers = 8;
    bool own_fix = true;
    bool satellite_ranges = true;
};

inline constexpr std::array gnss_options{
    option<&GnssSettings::elevation_mask_deg>("elevation_mask_deg", "deg", 0, 60,
                                              "Satellites lower than this above the horizon are not used."),
    option<&GnssSettings::min_carrier_to_noise_dbhz>("min_carrier_to_noise_dbhz", "dBHz", 0, 60,
                                                     "Signals weaker than this are not used."),
    option<&GnssSettings::max_ephemeris_age_s>(
        "max_ephemeris_age_s", "s", 600, 86400,
        "How far from its reference time an ephemeris is used: GPS, QZSS, Galileo, BeiDou."),
    option<&GnssSettings::max_glonass_age_s>("max_glonass_age_s", "s", 600, 43200, "The same for GLONASS."),
    option<&GnssSettings::orbit_sigma_m>(
        "orbit_sigma_m", "m", 0.01, 100,
        "Standard deviation of what broadcast orbit and clock add to a pseudorange, of a "
        "satellite that states the best accuracy; the others in proportion."),
    option<&GnssSettings::code_sigma_m>(
        "code_sigma_m", "m", 0.01, 100,
        "Of multipath: its part that is the same everywhere, and its part at the zenith that grows towards the "
        "horizon. GLONASS: 1.5 times."),
    option<&GnssSettings::noise_at_0_dbhz_m>(
        "noise_at_0_dbhz_m", "m", 0, 10000,
        "Noise of a pseudorange at 0 dBHz, a tenth for each 20 dBHz more; where the receiver states none itself."),
    option<&GnssSettings::rate_sigma_mps>("rate_sigma_mps", "m/s", 0.001, 10,
                                          "Of a Doppler as speed: for strong signals, 1.4 times at 45 dBHz, ten "
                                          "times for each 20 dBHz less."),
    option<&GnssSettings::max_correction_age_s>("max_correction_age_s", "s", 0, 600,
                                                "How old what a base station measured may be to correct a receiver. 0: "
                                                "only what was measured at the very same time."),
    option<&GnssSettings::ionosphere_gradient_mpkm>(
        "ionosphere_gradient_mpkm", "m/km", 0, 1,
        "By how much the ionosphere's delay at the zenith differs for each kilometre between base and receiver."),
    option<&GnssSettings::false_alarm>("false_alarm", "", 1e-9, 0.1,
                                       "Chance that pseudoranges without fault are taken for inconsistent."),
    option<&GnssSettings::gather_s>("gather_s", "s", 0, 1,
                                    "How long after its first signal an epoch is waited for to be complete; never "
                                    "longer than fusion.window_s allows."),
    option<&GnssSettings::max_receivers>("max_receivers", "", 0, 4096,
                                         "Receivers with raw observations that memory is set aside for."),
    option<&GnssSettings::own_fix>("own_fix",
                                   "Whether a receiver that tells no fixes gets them, worked out from its raw "
                                   "observations, for estimators that take only fixes."),
    option<&GnssSettings::satellite_ranges>("satellite_ranges", "Whether corrected pseudoranges are given to "
                                                                "estimators (tightly coupled)."),
};

} // namespace locus
