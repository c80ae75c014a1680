// PETS 2009 S2.L1 as the tests read it: annotated people, public detections and the camera, all in the annotations'
// pixels (768 x 576). Frame n of the detections (from 1) is frame n - 1 of the video.
#pragma once

#include "fusion/vision/camera_model.h"
#include "tests/replay/data.h"
#include "tests/replay/tracking_score.h"

#include <pugixml.hpp>

#include <cstdio>
#include <optional>
#include <vector>

namespace locus::test {

inline constexpr double pets_frame_s = 1. / 7;
inline constexpr float pets_scale = 1.6F; ///< the video at hand is 480 x 360

/// The lower middle of a box.
inline Eigen::Vector2d foot_of(const vision::BoxPx& box) { return {box.left_px + 0.5 * box.width_px, box.bottom_px()}; }

inline BoxesOfFrame annotated_people(const pugi::xml_node& frame) {
    BoxesOfFrame people;
    for (const auto& object : frame.child("objectlist").children("object")) {
        const auto box = object.child("box");
        const float width_px = box.attribute("w").as_float(), height_px = box.attribute("h").as_float();
        people.push_back({object.attribute("id").as_uint(),
                          {box.attribute("xc").as_float() - width_px / 2,
                           box.attribute("yc").as_float() - height_px / 2, width_px, height_px}});
    }
    return people;
}

/// A frame each, or nothing where the data are not.
inline std::vector<BoxesOfFrame> annotations(const std::string& name) {
    std::vector<BoxesOfFrame> frames;
    pugi::xml_document document;
    const auto path = recorded("pets2009/data/annotations/" + name);
    if (!path || !document.load_file(path->c_str())) return frames;
    for (const auto& frame : document.child("dataset").children("frame")) frames.push_back(annotated_people(frame));
    return frames;
}

/// MOT challenge: frame, -1, left, top, width, height, score, ...
inline std::vector<std::vector<vision::Detection>> public_detections(std::size_t frames) {
    std::vector<std::vector<vision::Detection>> detections(frames);
    const auto path = recorded("mot15_sort_det/PETS09-S2L1/det/det.txt");
    if (!path) return detections;
    std::ifstream file(*path);
    for (std::string line; std::getline(file, line);) {
        std::size_t frame = 0;
        vision::Detection d;
        if (std::sscanf(line.c_str(), "%zu,%*f,%f,%f,%f,%f,%f", &frame, &d.box.left_px, &d.box.top_px, &d.box.width_px,
                        &d.box.height_px, &d.score) == 6 &&
            frame >= 1 && frame <= frames)
            detections[frame - 1].push_back(d);
    }
    return detections;
}

} // namespace locus::test
