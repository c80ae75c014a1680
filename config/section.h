// The sections of a settings file, one file each: read and print stand side by side, so one cannot forget what the
// other knows.
#pragma once

#include "config/map_reader.h"
#include "config/settings.h"

#include <string>

namespace locus::config {

void read_site(const YamlNode& node, Site& site, Problems& problems);
std::string print_site(const Site& site);

void read_targets(const YamlNode& node, std::vector<TargetSettings>& targets, Problems& problems);
std::string print_targets(const std::vector<TargetSettings>& targets);

/// One item of the list; `more` are tables of further keys that may stand in its map.
void read_input(const YamlNode& item, InputSettings& input, std::span<const BoundOptions> more, Problems& problems);
void read_inputs(const YamlNode& node, std::vector<InputSettings>& inputs, Problems& problems);
std::string print_inputs(const std::vector<InputSettings>& inputs);

void read_cameras(const YamlNode& node, std::vector<CameraInputSettings>& cameras, Problems& problems);
std::string print_cameras(const std::vector<CameraInputSettings>& cameras);

/// Recordings and the socket carry the name of an input or camera as one word.
void check_one_word(const YamlNode& item, const std::string& name, Problems& problems);

/// Makes an entry for every estimator there is, also those that the file does not name.
void read_estimators(const YamlNode& node, std::vector<EstimatorSettings>& estimators, Problems& problems);
std::string print_estimators(const std::vector<EstimatorSettings>& estimators);

/// A section that is one option table.
struct FlatSection {
    std::string_view name;
    std::string_view about;
    Options rows;
    void* (*settings)(Settings&);
};
std::span<const FlatSection> flat_sections();

inline constexpr std::size_t max_anchors = 1024;
inline constexpr std::size_t max_walls = 4096;
inline constexpr std::size_t max_listed_targets = 4096;
inline constexpr std::size_t max_inputs = 64;
inline constexpr std::size_t max_cameras = 16;

} // namespace locus::config
