// What an installer says of one camera: where its frames come from, how it was calibrated, and who finds the people in
// it, or who wears it and has its way told by it.
#pragma once

#include "config/row_option.h"
#include "drivers/camera/detector.h"
#include "drivers/camera/frame_sources.h"
#include "drivers/camera/odometry/visual_odometer.h"
#include "fusion/vision/tracker_settings.h"

#include <array>
#include <memory>
#include <string>

namespace locus {

/// A standing person: 1.7 m, 0.1 m (means of adults from 1.6 to 1.8 m by sex and country, 0.07 m within each:
/// NCD-RisC 2016, "A century of trends in adult human height").
struct CameraInputSettings {
    std::string name;
    const camera::FrameSourceRow* source = nullptr;
    std::shared_ptr<void> source_settings;
    const camera::DetectorRow* detector = nullptr;
    std::shared_ptr<void> detector_settings;
    vision::TrackerSettings tracker;
    std::string calibration;
    double person_height_m = 1.7;
    double person_height_sigma_m = 0.1;
    Address worn_by = no_address;
    camera::OdometerSettings odometry; ///< of a worn one
    bool enabled = true;

    bool is_worn() const { return worn_by != no_address; }
};

/// The rows of every camera; after them come those of one that hangs or of one that is worn, then the source's.
inline constexpr std::array camera_input_options{
    required_option<&CameraInputSettings::name>("name", "Name that people see and recordings carry, one word."),
    row_option<&CameraInputSettings::source, camera::find_frame_source>(
        "source", "Where its frames come from: one of the sources below."),
    option<&CameraInputSettings::calibration>(
        "calibration", "File of `locus calibrate camera`, or Tsai's XML; left out: people are seen, but not placed. A "
                       "worn camera needs one, with its lens."),
    option<&CameraInputSettings::worn_by>(
        "worn_by",
        "Address of the tag whose wearer carries it: then it tells its way (docs/visual-odometry.md) instead "
        "of looking for people."),
    option<&CameraInputSettings::enabled>("enabled", "Whether the camera is opened at all."),
};

/// Of a camera that hangs and looks at people; the detector's and the tracker's own come after them.
inline constexpr std::array onlooker_options{
    row_option<&CameraInputSettings::detector, camera::find_detector>(
        "detector", "Who finds the people in them: one of the detectors below."),
    option<&CameraInputSettings::person_height_m>("person_height_m", "m", 0.5, 3, "Height of people, in the mean."),
    option<&CameraInputSettings::person_height_sigma_m>("person_height_sigma_m", "m", 0.001, 1,
                                                        "How much they differ in it."),
};

} // namespace locus
