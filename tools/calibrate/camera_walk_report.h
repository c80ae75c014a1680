// `locus calibrate camera walk` in words: what came out, or why nothing did and what to do.
#pragma once

#include "fusion/vision/survey/walk_fit.h"
#include "tools/calibrate/seen_feet.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace locus::calibrate {

/// Of a walk that is refused.
std::string sentence_of(const vision::survey::WalkFit& walk, const SeenFeet& seen,
                        const std::vector<vision::survey::PathPoint>& path, const CameraWalkRequest& request);

/// Of a walk that is good.
std::vector<std::string> report_lines(const vision::survey::WalkFit& walk, const SeenFeet& seen);
nlohmann::json report_json(const vision::survey::WalkFit& walk, const SeenFeet& seen);
std::vector<std::string> remarks_of(const vision::survey::WalkFit& walk);

} // namespace locus::calibrate
