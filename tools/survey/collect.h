// From recordings of somebody who walks about, and where they were, to a radio map.
#pragma once

#include "config/settings.h"
#include "fusion/radio/radio_map.h"
#include "tools/evaluate/track.h"

#include <cstdint>
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
    std::string site, date, device;
};

struct Collected {
    radio::RadioMap map;
    std::uint64_t readings = 0;  ///< that went into it
    std::uint64_t unplaced = 0;  ///< heard when nobody knew where
    std::uint64_t bad_lines = 0; ///< of the recordings
};

/// The place at a time between two poses at most a second apart; empty elsewhere.
std::optional<Vec3> place_at(const evaluate::Track& track, double time_s);

/// Throws std::runtime_error with a sentence when a file cannot be read or the numbers of files do not fit.
Collected collect(const Request& request, const Settings& settings);

} // namespace locus::survey
