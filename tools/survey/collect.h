// From recordings of somebody who walks about, and where they were, to a radio map.
#pragma once

#include "config/settings.h"
#include "tools/survey/collector.h"

#include <optional>
#include <string>
#include <vector>

namespace locus::survey {

struct Request {
    std::vector<std::string> recordings;
    /// Poses (TUM or POSE lines) of each recording, or one file for all of them; empty: `stood_site_m`.
    std::vector<std::string> poses;
    std::optional<Vec3> stood_site_m; ///< where all was heard
    double cell_m = 2;
    Heading heading;
};

/// Throws std::runtime_error with a sentence when a file cannot be read or the numbers of files do not fit.
Collected collect(const Request& request, const Settings& settings);

} // namespace locus::survey
