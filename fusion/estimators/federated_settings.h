// What can be set of the federated filter. Where the defaults come from:
// - height of a tag 1.0 m +- 0.3: worn between hip and chest of people of 1.5 to 1.9 m.
// - half of the information to each local filter: neither is known to be better. Any shares are honest
//   (filter/information_sum.h); a local filter alone is then the wider by what a doubled process noise makes, 2^(1/8)
//   or a tenth of its standard deviation.
// - feet beside the tag 0.2 m for 1 s: as inertial_ekf_settings.h has it. A tracker filters, so nearly all of a foot
//   point's error is that of the one before: on PETS 2009 (tests/replay/pets_test.cpp) its correlation is 0.89 from
//   image to image and down to 1/e in 0.9 s.
// - gate: that of range_ekf_settings.h. Patience half a second: as long as a tracker takes to show somebody who was
//   taken for another, and short enough that the prediction still says where he is not.
// - 2 s of silence: then two steady seconds say less of where somebody is than the next foot point does.
#pragma once

#include "fusion/estimators/kalman.h"

namespace locus {

struct FederatedSettings : CarriedPcaSettings {
    FederatedSettings() {
        planar = true; // always
        height_m = 1.0;
    }
    double tag_height_sigma_m = 0.3;
    double uwb_share = 0.5;
    double foot_error_sigma_m = 0.2;
    double foot_error_share = 0.9;
    double foot_error_time_s = 1;
    double gate_false_alarm = 1e-4;
    double gate_patience_s = 0.5;
    double restart_after_s = 2;
};

inline constexpr std::array federated_only_options{
    option<&CarriedPcaSettings::anchor_error_time_s, FederatedSettings>(
        "anchor_error_time_s", "s", 0.01, 1e6, "Time in which an anchor's error becomes another one."),
    option<&FederatedSettings::height_m, FederatedSettings>(
        "tag_height_m", "m", -1e5, 1e5, "Height over the floor at which people wear the tag; not estimated."),
    option<&FederatedSettings::tag_height_sigma_m>("tag_height_sigma_m", "m", 0, 100,
                                                   "Standard deviation of that height, as published."),
    option<&FederatedSettings::uwb_share>(
        "uwb_share", "", 0.05, 0.95, "Share of information that is the UWB filter's; the rest is the visual one's."),
    option<&FederatedSettings::foot_error_sigma_m>(
        "foot_error_sigma_m", "m", 0, 100,
        "How far the feet that a camera sees lie beside the tag, beyond the camera's own doubt."),
    option<&FederatedSettings::foot_error_share>("foot_error_share", "", 0, 0.99,
                                                 "Share of a foot point's variance that the next one has as well."),
    option<&FederatedSettings::foot_error_time_s>("foot_error_time_s", "s", 0.01, 1e6,
                                                  "Time in which that error becomes another one."),
    option<&FederatedSettings::gate_false_alarm>("gate_false_alarm", "", 1e-12, 0.5,
                                                 "Chance that a good foot point is refused."),
    option<&FederatedSettings::gate_patience_s>(
        "gate_patience_s", "s", 0, 60,
        "For how long foot points are refused before the visual filter starts anew at the next."),
    option<&FederatedSettings::restart_after_s>("restart_after_s", "s", 0.1, 3600,
                                                "Silence after which a local filter starts anew."),
};

inline constexpr auto all_federated_options =
    joined(joined(joined(reading_options<FederatedSettings>, epoch_gathering_options<FederatedSettings>),
                  joined(velocity_options<FederatedSettings>, pca_options<FederatedSettings>)),
           federated_only_options);

} // namespace locus
