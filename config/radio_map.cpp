#include "config/radio_map.h"

#include "config/address.h"
#include "config/map_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace locus::config {
namespace {

using radio::RadioMap;
using radio::ReferencePoint;
using radio::Strength;

constexpr std::array heading_options{
    option<&RadioMap::site>("site", "Name of the site."),
    option<&RadioMap::date>("date", "When it was collected."),
    option<&RadioMap::device>("device", "What it was collected with."),
};
constexpr std::array point_options{
    option<&ReferencePoint::position_site_m>("position_site_m", "m", -1e5, 1e5, "Where somebody stood.", {}, true),
};
constexpr std::array strength_options{
    option<&Strength::beacon>("beacon", "", -no_limit, no_limit, "Its address.", {}, true),
    option<&Strength::mean_dbm>("mean_dbm", "dBm", radio::weakest_dbm, radio::strongest_dbm, "Mean strength.", {},
                                true),
    option<&Strength::spread_db>("spread_db", "dB", 0, 100, "Standard deviation of single readings."),
    option<&Strength::count>("count", "", 1, 1e9, "Of readings."),
};
constexpr std::array<std::string_view, 1> map_lists{"points"}, point_lists{"heard"};
constexpr std::size_t least_points = 3;

/// [beacon, mean_dbm, spread_db, count]; the last two may be left out.
void read_strength(const YamlNode& item, ReferencePoint& point, Problems& problems) {
    if (item.kind != YamlNode::Kind::list || item.children.size() < 2 ||
        item.children.size() > strength_options.size()) {
        problems.add(item.mark, "a strength must be a list: [beacon, mean_dbm, spread_db, count]");
        return;
    }
    Strength strength;
    for (std::size_t i = 0; i < item.children.size(); ++i) {
        const OptionRow& row = strength_options[i];
        const auto value = read_value(item.children[i], row, row.get(&strength), problems);
        if (!value.has_value()) return;
        row.set(&strength, value.value());
    }
    if (radio::find(point, strength.beacon) != nullptr)
        problems.add(item.mark, fmt::format("beacon {} stands here twice", to_text(strength.beacon)));
    else
        point.heard.push_back(strength);
}

void read_point(const YamlNode& item, RadioMap& map, Problems& problems) {
    ReferencePoint& point = map.points.emplace_back();
    const BoundOptions table[]{{point_options, &point}};
    if (!read_map(item, {"point", point_lists}, table, problems)) return;
    if (const YamlNode* heard = item.find("heard"))
        for (const YamlNode& each : list_items(*heard, radio::max_beacons, problems))
            read_strength(each, point, problems);
}

void check_enough(const RadioMap& map, Problems& problems) {
    if (map.points.size() < least_points)
        problems.add({}, fmt::format("a radio map needs at least {} points", least_points));
    else if (radio::beacons_of(map, least_points).empty())
        problems.add({}, fmt::format("no beacon was heard at {} points or more", least_points));
}

std::string strength_yaml(const Strength& strength) {
    return fmt::format("[{}, {:.1f}, {:.1f}, {}]", to_text(strength.beacon), strength.mean_dbm, strength.spread_db,
                       strength.count);
}

std::string point_yaml(const ReferencePoint& point) {
    const Vec3& place = point.position_site_m;
    std::string text =
        fmt::format("  - {{position_site_m: [{:.3f}, {:.3f}, {:.3f}], heard: [", place[0], place[1], place[2]);
    for (std::size_t i = 0; i < point.heard.size(); ++i) text += (i > 0 ? ", " : "") + strength_yaml(point.heard[i]);
    return text + "]}\n";
}

} // namespace

std::optional<RadioMap> parse_radio_map(std::string_view text, Problems& problems) {
    const std::size_t before = problems.size();
    const auto root = parse_yaml(text, problems);
    if (!root.has_value()) return std::nullopt;
    const YamlNode& tree = root.value();
    RadioMap map;
    const BoundOptions table[]{{heading_options, &map}};
    if (!read_map(tree, {"the radio map", map_lists}, table, problems)) return std::nullopt;
    if (const YamlNode* points = tree.find("points"))
        for (const YamlNode& item : list_items(*points, radio::max_reference_points, problems))
            read_point(item, map, problems);
    if (problems.size() == before) check_enough(map, problems);
    return problems.size() == before ? std::optional(std::move(map)) : std::nullopt;
}

std::string radio_map_yaml(const RadioMap& map) {
    std::string text;
    for (const OptionRow& row : heading_options) text += fmt::format("{}: {}\n", row.name, to_yaml(row.get(&map)));
    text += "# beacon, mean dBm, spread dB, readings\npoints:\n";
    for (const ReferencePoint& point : map.points) text += point_yaml(point);
    return text;
}

} // namespace locus::config
