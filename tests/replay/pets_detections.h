// Our own detections on the PETS 2009 S2.L1 video, in the annotations' pixels.
#pragma once

#include "drivers/camera/detector.h"
#include "drivers/camera/people.h"
#include "drivers/camera/recorded_source.h"
#include "tests/replay/pets.h"

#include <string>
#include <utility>
#include <vector>

namespace locus::test {

inline vision::Detection in_annotations(vision::Detection detection) {
    vision::BoxPx& box = detection.box;
    for (float* length : {&box.left_px, &box.top_px, &box.width_px, &box.height_px}) *length *= pets_scale;
    return detection;
}

/// How high people are in the video, of the calibration of the larger pictures: what the daemon tells its detectors.
inline camera::ExpectedHeight heights_in_video(const vision::FloorView& view) {
    return [in_annotations = camera::expected_height(view, {})](float foot_x_px, float foot_y_px) {
        return in_annotations(foot_x_px * pets_scale, foot_y_px * pets_scale) / pets_scale;
    };
}

/// A frame each; empty where the video is not. An empty function as `height`: it is learnt on the way.
inline std::vector<std::vector<vision::Detection>> own_detections(const std::string& detector_name, std::size_t frames,
                                                                  const camera::ExpectedHeight& height) {
    std::vector<std::vector<vision::Detection>> found(frames);
    const auto path = recorded("pets2009/vtest_480x360_795f.avi");
    if (!path) return {};
    const auto video = camera::make_recorded_source({.path = *path, .speed = 0}, Timestamp{});
    if (!video->open()) return {};
    const camera::DetectorRow* row = camera::find_detector(detector_name);
    const auto settings = row->options.make();
    std::string error;
    const auto detector = row->make(settings.get(), height, error);
    for (camera::Frame frame;
         video->next(frame, Duration{0}) == camera::FrameStatus::frame && frame.sequence < found.size();)
        for (auto& detection : detector->detect(frame.picture))
            found[frame.sequence].push_back(in_annotations(std::move(detection)));
    return found;
}

} // namespace locus::test
