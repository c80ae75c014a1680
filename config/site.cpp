// Section "site": anchors, walls, and where the site lies on the Earth.
#include "config/address.h"
#include "config/print_options.h"
#include "config/section.h"
#include "config/uniques.h"

namespace locus::config {
namespace {

void read_anchors(const YamlNode& list, std::vector<Anchor>& anchors, Problems& problems) {
    Uniques names("anchor with the name");
    Uniques addresses("anchor with the address");
    for (const auto& item : list_items(list, max_anchors, problems)) {
        Anchor& anchor = anchors.emplace_back();
        const BoundOptions table[]{{anchor_options, &anchor}};
        if (!read_map(item, {"anchor"}, table, problems)) continue;
        if (!anchor.name.empty()) names.check(anchor.name, item.mark, problems);
        if (anchor.address != no_address) addresses.check(to_text(anchor.address), item.mark, problems);
    }
}

void read_walls(const YamlNode& list, std::vector<Wall>& walls, Problems& problems) {
    for (const auto& item : list_items(list, max_walls, problems)) {
        const BoundOptions table[]{{wall_options, &walls.emplace_back()}};
        read_map(item, {"wall"}, table, problems);
    }
}

void read_origin(const YamlNode& map, std::optional<Wgs84Anchor>& origin, Problems& problems) {
    if (map.kind == YamlNode::Kind::nothing) return;
    const BoundOptions table[]{{origin_options, &origin.emplace()}};
    read_map(map, {"origin"}, table, problems);
}

} // namespace

void read_site(const YamlNode& node, Site& site, Problems& problems) {
    static constexpr std::string_view other_keys[]{"anchors", "walls", "origin"};
    const BoundOptions table[]{{site_options, &site}};
    if (!read_map(node, {"site", other_keys}, table, problems)) return;
    if (const YamlNode* anchors = node.find("anchors")) read_anchors(*anchors, site.anchors, problems);
    if (const YamlNode* walls = node.find("walls")) read_walls(*walls, site.walls, problems);
    if (const YamlNode* origin = node.find("origin")) read_origin(*origin, site.origin, problems);
}

std::string print_site(const Site& site) {
    const ShownOptions table[]{{site_options, &site}};
    std::string text = "site:\n" + print_block(table, 2);
    if (site.origin) text += "  origin: " + print_flow({origin_options, &*site.origin}) + "\n";
    text += site.anchors.empty() ? "  anchors: []\n" : "  anchors:\n";
    for (const auto& anchor : site.anchors) text += "    - " + print_flow({anchor_options, &anchor}) + "\n";
    if (!site.walls.empty()) text += "  walls:\n";
    for (const auto& wall : site.walls) text += "    - " + print_flow({wall_options, &wall}) + "\n";
    return text;
}

} // namespace locus::config
