// Section "targets": the tags that have a name or an estimator of their own.
#include "config/address.h"
#include "config/names.h"
#include "config/print_options.h"
#include "config/section.h"
#include "config/uniques.h"

namespace locus::config {

void read_targets(const YamlNode& node, std::vector<TargetSettings>& targets, Problems& problems) {
    Uniques names("target with the name");
    Uniques addresses("target with the address");
    for (const auto& item : list_items(node, max_listed_targets, problems)) {
        TargetSettings& target = targets.emplace_back();
        const BoundOptions table[]{{target_options, &target}};
        if (!read_map(item, {"target"}, table, problems)) continue;
        if (!target.name.empty()) names.check(target.name, item.mark, problems);
        if (target.address != no_address) addresses.check(to_text(target.address), item.mark, problems);
        if (!target.estimator.empty()) find_named(item.find("estimator"), "estimator", estimator_table(), problems);
    }
}

std::string print_targets(const std::vector<TargetSettings>& targets) {
    if (targets.empty()) return "targets: []\n";
    std::string text = "targets:\n";
    for (const auto& target : targets) text += "  - " + print_flow({target_options, &target}) + "\n";
    return text;
}

} // namespace locus::config
