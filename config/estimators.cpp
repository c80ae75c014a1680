// Section "estimators": one map for each estimator whose settings are not the defaults.
#include "config/names.h"
#include "config/print_options.h"
#include "config/section.h"

#include <fmt/format.h>

namespace locus::config {
namespace {

void find_unknown_estimators(const YamlNode& node, Problems& problems) {
    for (const auto& child : node.children)
        if (!find_estimator(child.key))
            problems.add(child.key_mark, fmt::format("there is no estimator \"{}\"{}", shown(child.key),
                                                     hint(child.key, names_of(estimator_table()))));
}

} // namespace

void read_estimators(const YamlNode& node, std::vector<EstimatorSettings>& estimators, Problems& problems) {
    const auto names = names_of(estimator_table());
    const MapKind kind{"estimators", names};
    const bool is_map = read_known_keys(node, kind, {}, problems);
    if (is_map) find_unknown_estimators(node, problems);
    for (const auto& row : estimator_table()) {
        const auto settings = row.options.make();
        const BoundOptions table[]{{row.options.rows, settings.get(), row.options.lists}};
        if (const YamlNode* own = is_map ? node.find(row.name) : nullptr) read_map(*own, {row.name}, table, problems);
        estimators.push_back({&row, settings});
    }
}

std::string print_estimators(const std::vector<EstimatorSettings>& estimators) {
    std::string text;
    for (const auto& estimator : estimators) {
        const ShownOptions table[]{
            {estimator.row->options.rows, estimator.settings.get(), estimator.row->options.lists}};
        text += fmt::format("  {}:\n{}", estimator.row->name, print_block(table, 4));
    }
    return text.empty() ? "estimators: {}\n" : "estimators:\n" + text;
}

} // namespace locus::config
