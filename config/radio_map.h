// A radio map's file: YAML (docs/radio.md), a line for each reference point.
#pragma once

#include "config/problems.h"
#include "fusion/engine.h"
#include "fusion/radio/radio_map.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace locus::config {

/// Empty with at least one problem: numbers out of range, too many points or beacons, a beacon twice at a point, fewer
/// than three points, no beacon that was heard at three. Never throws but std::bad_alloc.
std::optional<radio::RadioMap> parse_radio_map(std::string_view text, Problems& problems);

/// parse_radio_map() reads it back, strengths to a tenth of a decibel, places to a millimetre.
std::string radio_map_yaml(const radio::RadioMap& map);

std::optional<radio::RadioMap> load_radio_map(const std::string& path, std::vector<ConfigProblem>& problems);

/// Into a new file that then takes the place of the old one: whoever reads has the old or the new one, whole. Throws
/// std::runtime_error with a sentence when it cannot be written, or would be too long to be read back.
void write_radio_map(const std::string& path, const radio::RadioMap& map);

/// Reads what the settings of radio_particles name; a path that is not whole is taken from `folder` on.
void load_radio_maps(std::vector<EstimatorSettings>& estimators, const std::filesystem::path& folder,
                     std::vector<ConfigProblem>& problems);

/// For a heading: YYYY-MM-DD, UTC.
std::string date_of_today();

/// All radio maps that the settings hold, as they were surveyed: another text, another engine.
std::string radio_maps_text(const std::vector<EstimatorSettings>& estimators);

} // namespace locus::config
