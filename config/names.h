// Names out of the tables of estimators, transports and decoders, and the error for a name that is not among them.
#pragma once

#include "config/nearest.h"
#include "config/plain_text.h"
#include "config/yaml_tree.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

namespace locus::config {

std::vector<std::string_view> names_of(const auto& table) {
    std::vector<std::string_view> names;
    for (const auto& row : table) names.push_back(row.name);
    return names;
}

/// The row that `node` names. A problem when there is none of that name; nullptr without a problem when the node is
/// absent or no text: the option table's own row has said so.
template <class Table>
auto find_named(const YamlNode* node, std::string_view what, const Table& table, Problems& problems) {
    const typename Table::element_type* found = nullptr;
    if (!node || node->kind != YamlNode::Kind::scalar) return found;
    for (const auto& row : table)
        if (row.name == node->text) found = &row;
    if (!found)
        problems.add(node->mark, fmt::format("there is no {} \"{}\"{}", what, shown(node->text),
                                             hint(node->text, names_of(table))));
    return found;
}

} // namespace locus::config
