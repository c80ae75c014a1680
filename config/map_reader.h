// A YAML map against option tables: the one place where unknown keys and missing ones are found.
#pragma once

#include "config/value.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace locus::config {

/// A table and the struct that its rows belong to.
struct BoundOptions {
    Options rows;
    void* settings;
    OptionLists lists{};
};

/// Every key that the table knows, appended.
void append_names(const BoundOptions& table, std::vector<std::string_view>& keys);

/// What a map is called in messages, and the keys in it that the caller reads by itself.
struct MapKind {
    std::string_view name; ///< "anchor", "input", ...
    std::span<const std::string_view> other_keys{};
};

/// Fills each bound struct from the map; keys that are left out keep their defaults. False when the node is no map.
/// An empty node counts as an empty map: a section whose lines are all commented out.
bool read_map(const YamlNode& node, const MapKind& kind, std::span<const BoundOptions> tables, Problems& problems);

/// The same without the search for unknown keys, for a map some of whose tables could not be found.
bool read_known_keys(const YamlNode& node, const MapKind& kind, std::span<const BoundOptions> tables,
                     Problems& problems);

/// The list's items; nothing, with a problem unless the node is empty, when the node is no list.
std::span<const YamlNode> list_items(const YamlNode& node, std::size_t longest, Problems& problems);

} // namespace locus::config
