#include "config/map_reader.h"
#include "config/nearest.h"
#include "config/plain_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace locus::config {
namespace {

constexpr std::size_t max_option_list = 256;

using Tables = std::span<const BoundOptions>;

bool is_map(const YamlNode& node, const MapKind& kind, Problems& problems) {
    if (node.kind == YamlNode::Kind::map || node.kind == YamlNode::Kind::nothing) return true;
    problems.add(node.mark, fmt::format("{} must be a map of \"key: value\" lines", kind.name));
    return false;
}

std::vector<std::string_view> known_keys(const MapKind& kind, Tables tables) {
    std::vector<std::string_view> keys(kind.other_keys.begin(), kind.other_keys.end());
    for (const auto& table : tables) append_names(table, keys);
    return keys;
}

void find_unknown_keys(const YamlNode& map, const MapKind& kind, Tables tables, Problems& problems) {
    const auto known = known_keys(kind, tables);
    for (const auto& child : map.children)
        if (std::ranges::find(known, child.key) == known.end())
            problems.add(child.key_mark, fmt::format("{} has no setting \"{}\"{}", kind.name, shown(child.key),
                                                     hint(child.key, known)));
}

void read_row(const YamlNode& map, const MapKind& kind, const OptionRow& row, void* settings, Problems& problems) {
    const YamlNode* node = map.find(row.name);
    if (!node && row.required)
        problems.add(map.mark, fmt::format("{} lacks \"{}\": {}", kind.name, row.name, row.about));
    if (!node) return;
    if (const auto value = read_value(*node, row, row.get(settings), problems)) row.set(settings, *value);
}

void read_list(const YamlNode& map, const OptionList& list, void* settings, Problems& problems) {
    const YamlNode* node = map.find(list.name);
    if (!node) return;
    const std::string item_name = fmt::format("an item of {}", list.name);
    for (const auto& item : list_items(*node, max_option_list, problems)) {
        const BoundOptions table[]{{list.rows, list.append(settings)}};
        read_map(item, {item_name}, table, problems);
    }
}

} // namespace

void append_names(const BoundOptions& table, std::vector<std::string_view>& keys) {
    for (const auto& row : table.rows) keys.push_back(row.name);
    for (const auto& list : table.lists) keys.push_back(list.name);
}

bool read_known_keys(const YamlNode& node, const MapKind& kind, Tables tables, Problems& problems) {
    if (!is_map(node, kind, problems)) return false;
    for (const auto& table : tables) {
        for (const auto& row : table.rows) read_row(node, kind, row, table.settings, problems);
        for (const auto& list : table.lists) read_list(node, list, table.settings, problems);
    }
    return true;
}

bool read_map(const YamlNode& node, const MapKind& kind, Tables tables, Problems& problems) {
    if (!read_known_keys(node, kind, tables, problems)) return false;
    find_unknown_keys(node, kind, tables, problems);
    return true;
}

std::span<const YamlNode> list_items(const YamlNode& node, std::size_t longest, Problems& problems) {
    if (node.kind == YamlNode::Kind::nothing) return {};
    if (node.kind != YamlNode::Kind::list) {
        problems.add(node.mark, fmt::format("{} must be a list, each item with \"- \" in front", node.key));
        return {};
    }
    if (node.children.size() > longest)
        problems.add(node.mark,
                     fmt::format("{} has {} items; at most {} are allowed", node.key, node.children.size(), longest));
    return std::span(node.children).first(std::min(longest, node.children.size()));
}

} // namespace locus::config
