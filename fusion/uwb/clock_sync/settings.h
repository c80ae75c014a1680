// What the clocks of anchors are taken for. A crystal's rate wanders with its temperature, which changes slowly: its
// drift (change of rate) is a random walk that comes to crystal_drift within crystal_drift_time. What the rate does
// from one moment to the next is the crystal's own noise, given by its Allan deviation at 1 s. The three-state model,
// offset, rate and drift, each with its own noise: Zucca, Tavella, The clock model and its relationship with the Allan
// and related variances, IEEE Trans. UFFC 52 (2005). Defaults: 20 ppm is what IEEE 802.15.4 allows; 0.1 ppm/s is what a
// board does while it warms up, ten times what the six anchors of ultrax_dw1000_raw did in a minute.
#pragma once

#include "fusion/measurement.h"
#include "fusion/option.h"

#include <array>

namespace locus {

struct ClockSyncSettings {
    Address master = no_address; ///< no_address: chosen from what is heard
    double arrival_sigma_m = 0.045;
    double max_clock_sigma_m = 1;
    double gather_s = 0.03;
    double wait_s = 0.16;
    int clock_bits = 40;
    double crystal_tolerance_ppm = 20;
    double crystal_drift_ppm_per_s = 0.1;
    double crystal_drift_time_s = 10;
    double crystal_noise_ppb = 0.1;
};

inline constexpr std::array clock_sync_options{
    option<&ClockSyncSettings::master>(
        "master",
        "Anchor whose clock is the site's; left out: the one by whose sync packets most anchors are reached."),
    option<&ClockSyncSettings::arrival_sigma_m>(
        "arrival_sigma_m", "m", 0.001, 10,
        "Standard deviation of a time of arrival, as a length (0.045 m: 150 ps), of blinks and of sync packets."),
    option<&ClockSyncSettings::max_clock_sigma_m>(
        "max_clock_sigma_m", "m", 0.01, 100,
        "An anchor whose clock is less certain than this against another's gives no range difference with it."),
    option<&ClockSyncSettings::gather_s>(
        "gather_s", "s", 0.001, 1, "By how much the arrivals of one blink may come apart from different anchors."),
    option<&ClockSyncSettings::wait_s>(
        "wait_s", "s", 0, 1,
        "How long a blink waits for the sync packet after it, which makes clocks far more certain than the one before "
        "alone; never longer than fusion.window_s allows. 0: it does not wait."),
    option<&ClockSyncSettings::clock_bits>(
        "clock_bits", "", 32, 40,
        "Bits of the stamps. With 32 they wrap each 67 ms, and delays on the way must stay below 30 ms."),
    option<&ClockSyncSettings::crystal_tolerance_ppm>("crystal_tolerance_ppm", "ppm", 0.1, 200,
                                                      "Standard deviation of a crystal's rate about its nominal one."),
    option<&ClockSyncSettings::crystal_drift_ppm_per_s>("crystal_drift_ppm_per_s", "ppm/s", 1e-6, 10,
                                                        "How fast the rate changes with temperature."),
    option<&ClockSyncSettings::crystal_drift_time_s>("crystal_drift_time_s", "s", 0.1, 1e5,
                                                     "For how long it goes on changing alike."),
    option<&ClockSyncSettings::crystal_noise_ppb>("crystal_noise_ppb", "ppb", 0, 1000,
                                                  "Allan deviation of the rate at 1 s."),
};

} // namespace locus
