#include "config/load.h"
#include "config/file_text.h"
#include "config/names.h"
#include "config/radio_map.h"
#include "config/section.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

namespace locus {
namespace config {
namespace {

constexpr std::array<FlatSection, 9> flat{{
    {"fusion", "The engine: how often, how late, how many.", fusion_options,
     [](Settings& settings) -> void* { return &settings.engine.fusion; }},
    {"clock_sync", "Clocks of anchors that tell raw times of arrival (docs/clock-sync.md).", clock_sync_options,
     [](Settings& settings) -> void* { return &settings.engine.clock_sync; }},
    {"anchor_health", "When an anchor is called blocked or moved (docs/anchors.md).", uwb::anchor_health_options,
     [](Settings& settings) -> void* { return &settings.engine.anchor_health; }},
    {"gnss", "Raw observations of GNSS receivers (docs/gnss.md).", gnss_options,
     [](Settings& settings) -> void* { return &settings.engine.gnss; }},
    {"vision", "Whose feet the cameras see (docs/cameras.md).", vision_options,
     [](Settings& settings) -> void* { return &settings.engine.vision; }},
    {"publish", "The socket that clients read.", publish_options,
     [](Settings& settings) -> void* { return &settings.publish; }},
    {"nmea", "The pose of one target as NMEA 0183, for GNSS software (docs/nmea.md).", nmea_output_options,
     [](Settings& settings) -> void* { return &settings.nmea; }},
    {"log", "What is written to the journal.", log_options, [](Settings& settings) -> void* { return &settings.log; }},
    {"realtime", "How the fusion thread is scheduled.", realtime_options,
     [](Settings& settings) -> void* { return &settings.realtime; }},
}};

constexpr std::array<std::string_view, 14> section_names{
    "site", "targets",    "inputs",  "cameras", "fusion", "clock_sync", "anchor_health",
    "gnss", "estimators", "publish", "vision",  "nmea",   "log",        "realtime"};

/// An absent section reads like an empty one.
const YamlNode& section(const YamlNode& root, std::string_view name) {
    static const YamlNode absent;
    const YamlNode* found = root.find(name);
    return found ? *found : absent;
}

/// `node`: the name of an estimator; nullptr where none is named.
void check_origin(const YamlNode* node, const Site& site, Problems& problems) {
    const EstimatorRow* row = node != nullptr ? find_estimator(node->text) : nullptr;
    if (row != nullptr && row->needs_origin && !site.origin)
        problems.add(node->mark,
                     fmt::format("estimator {} needs site.origin: where on the Earth the site lies", row->name));
}

void check_nmea(const YamlNode& node, const Settings& settings, Problems& problems) {
    const YamlNode* target = node.find("target");
    if (target == nullptr || settings.nmea.target.empty()) return;
    if (!settings.engine.site.origin)
        problems.add(target->mark, "nmea needs site.origin: where on the Earth the site lies; GNSS software knows no "
                                   "metres from a corner");
    if (std::ranges::find(settings.engine.targets, settings.nmea.target, &TargetSettings::name) ==
        settings.engine.targets.end())
        problems.add(target->mark, fmt::format("nmea.target {} is not the name of one of the targets", target->text));
}

/// A recording knows both by their names.
void check_names(const YamlNode& cameras, const Settings& settings, Problems& problems) {
    for (const CameraInputSettings& camera : settings.cameras)
        if (!camera.name.empty() &&
            std::ranges::find(settings.inputs, camera.name, &InputSettings::name) != settings.inputs.end())
            problems.add(cameras.mark, fmt::format("{} is the name of both an input and a camera", camera.name));
}

void check_limits_between(const YamlNode& root, const Settings& settings, Problems& problems) {
    constexpr std::size_t longest_socket_path = 107; // sockaddr_un::sun_path less its terminating zero
    const auto& fusion = settings.engine.fusion;
    find_named(section(root, "fusion").find("estimator"), "estimator", estimator_table(), problems);
    check_origin(section(root, "fusion").find("estimator"), settings.engine.site, problems);
    for (const YamlNode& target : section(root, "targets").children)
        check_origin(target.find("estimator"), settings.engine.site, problems);
    check_nmea(section(root, "nmea"), settings, problems);
    check_names(section(root, "cameras"), settings, problems);
    const Address master = settings.engine.clock_sync.master;
    if (master != no_address && settings.engine.site.find_anchor(master) == nullptr)
        problems.add(section(root, "clock_sync").find("master")->mark,
                     "master is not the address of an anchor of the site");
    if (settings.publish.socket.size() > longest_socket_path)
        problems.add(section(root, "publish").find("socket")->mark, "socket is longer than the 107 letters that the "
                                                                    "kernel takes");
    if (settings.engine.targets.size() > static_cast<std::size_t>(fusion.max_targets))
        problems.add(section(root, "targets").mark, fmt::format("{} targets are listed, but fusion.max_targets is {}",
                                                                settings.engine.targets.size(), fusion.max_targets));
}

Settings read_sections(const YamlNode& root, Problems& problems) {
    Settings settings;
    if (!read_map(root, {"the file", section_names}, {}, problems)) return settings;
    read_site(section(root, "site"), settings.engine.site, problems);
    read_targets(section(root, "targets"), settings.engine.targets, problems);
    read_inputs(section(root, "inputs"), settings.inputs, problems);
    read_cameras(section(root, "cameras"), settings.cameras, problems);
    settings.engine.cameras = settings.cameras.size();
    read_estimators(section(root, "estimators"), settings.engine.estimators, problems);
    for (const auto& one : flat) {
        const BoundOptions table[]{{one.rows, one.settings(settings)}};
        read_map(section(root, one.name), {one.name}, table, problems);
    }
    check_limits_between(root, settings, problems);
    return settings;
}

Settings read_text(std::string_view yaml, Problems& problems) {
    const auto root = parse_yaml(yaml, problems);
    if (!root) return {};
    if (root->kind == YamlNode::Kind::nothing) {
        problems.add({}, "the file is empty; it needs at least a site with anchors and one input");
        return {};
    }
    return read_sections(*root, problems);
}

} // namespace

std::span<const FlatSection> flat_sections() { return flat; }

} // namespace config

LoadResult load_settings_text(std::string_view yaml, const std::string& file_name) {
    config::Problems problems(file_name);
    LoadResult result;
    Settings settings = config::read_text(yaml, problems);
    if (problems.empty()) result.settings = std::move(settings);
    result.problems = problems.take();
    return result;
}

LoadResult load_settings(const std::string& path) {
    std::string error;
    const auto text = config::read_file(path, error);
    if (!text) return {std::nullopt, {{path, 0, 0, error}}, false};
    LoadResult result = load_settings_text(*text, path);
    if (!result.settings) return result;
    config::load_radio_maps(result.settings->engine.estimators, std::filesystem::path(path).parent_path(),
                            result.problems);
    if (!result.problems.empty()) result.settings.reset();
    return result;
}

} // namespace locus
