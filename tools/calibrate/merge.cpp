#include "tools/calibrate/merge.h"

#include "config/address.h"
#include "config/file_text.h"
#include "config/load.h"
#include "config/yaml_tree.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace locus::calibrate {
namespace {

using config::Mark;
using config::YamlNode;

/// Some characters of the text in place of others.
struct Change {
    std::size_t at = 0;
    std::size_t length = 0;
    std::string text;
};

[[noreturn]] void cannot(const std::string& why) {
    throw std::runtime_error("the settings file cannot be edited: " + why + "; paste the lines above by hand");
}

std::size_t offset_of(const std::string& text, Mark mark) {
    std::size_t at = 0;
    for (int line = 1; line < mark.line; ++line) {
        at = text.find('\n', at);
        if (at == std::string::npos) cannot("a line of it was lost");
        ++at;
    }
    return at + static_cast<std::size_t>(std::max(mark.column - 1, 0));
}

YamlNode tree_of(const std::string& yaml) {
    config::Problems problems("the settings file");
    auto root = config::parse_yaml(yaml, problems);
    if (!root || !problems.empty()) cannot("it has problems; `locus check` tells them");
    return *std::move(root);
}

const YamlNode& item_of(const YamlNode& root, Address anchor) {
    const YamlNode* site = root.find("site");
    const YamlNode* anchors = site ? site->find("anchors") : nullptr;
    if (anchors)
        for (const YamlNode& item : anchors->children)
            if (const YamlNode* said = item.find("address"); said && config::parse_address(said->text) == anchor)
                return item;
    cannot(fmt::format("it has no anchor with the address {}", config::to_text(anchor)));
}

/// Begin and length of "[...]" behind position_site_m.
Change position_of(const std::string& yaml, const YamlNode& item) {
    const YamlNode* position = item.find("position_site_m");
    if (!position) cannot("an anchor has no position_site_m");
    const std::size_t begin = offset_of(yaml, position->mark);
    const std::size_t end = yaml.find(']', begin);
    if (begin >= yaml.size() || yaml[begin] != '[' || end == std::string::npos)
        cannot("position_site_m is not written as [x, y, z]");
    return {begin, end + 1 - begin, ""};
}

Change bias_change(const std::string& yaml, const YamlNode& item, double bias_m) {
    if (const YamlNode* old = item.find("range_bias_m")) {
        const std::size_t at = offset_of(yaml, old->mark);
        if (old->quoted || yaml.compare(at, old->text.size(), old->text) != 0) cannot("range_bias_m is not plain");
        return {at, old->text.size(), yaml_of(bias_m)};
    }
    const Change position = position_of(yaml, item);
    const bool flow = yaml.at(offset_of(yaml, item.mark)) == '{';
    const auto indent = static_cast<std::size_t>(std::max(item.find("position_site_m")->key_mark.column - 1, 0));
    const std::string lead = flow ? ", " : "\n" + std::string(indent, ' ');
    return {position.at + position.length, 0, lead + "range_bias_m: " + yaml_of(bias_m)};
}

std::string changed(std::string yaml, std::vector<Change> changes) {
    std::ranges::sort(changes, std::greater{}, &Change::at);
    for (const Change& change : changes) yaml.replace(change.at, change.length, change.text);
    return yaml;
}

bool near(double one_m, double other_m) { return std::abs(one_m - other_m) < 0.001; }

void check(const std::string& yaml, const std::vector<AnchorEdit>& edits) {
    const auto loaded = load_settings_text(yaml, "the edited file");
    if (!loaded.settings) cannot("what came out has problems");
    for (const AnchorEdit& edit : edits) {
        const Anchor* anchor = loaded.settings->engine.site.find_anchor(edit.anchor);
        bool good = anchor != nullptr;
        for (std::size_t axis = 0; good && edit.position_site_m && axis < 3; ++axis)
            good = near(anchor->position_site_m[axis], (*edit.position_site_m)[axis]);
        if (good && edit.range_bias_m) good = near(anchor->range_bias_m, *edit.range_bias_m);
        if (!good) cannot("what came out does not say what it should");
    }
}

void replace_file(const std::string& path, const std::string& text) {
    const auto target = std::filesystem::canonical(path);
    const std::string beside = target.string() + ".new";
    std::ofstream file(beside, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw std::runtime_error("'" + beside + "' cannot be written");
    std::filesystem::permissions(beside, std::filesystem::status(target).permissions());
    std::filesystem::rename(beside, target);
}

} // namespace

std::string yaml_of(double length_m) {
    const double mm = std::round(1000 * length_m);
    return fmt::format("{}", (mm == 0 ? 0 : mm) / 1000);
}

std::string yaml_of(const Vec3& position_m) {
    return fmt::format("[{}, {}, {}]", yaml_of(position_m[0]), yaml_of(position_m[1]), yaml_of(position_m[2]));
}

std::string merged(const std::string& yaml, const std::vector<AnchorEdit>& edits) {
    const YamlNode root = tree_of(yaml);
    std::vector<Change> changes;
    for (const AnchorEdit& edit : edits) {
        const YamlNode& item = item_of(root, edit.anchor);
        if (edit.range_bias_m) changes.push_back(bias_change(yaml, item, *edit.range_bias_m));
        if (edit.position_site_m) {
            changes.push_back(position_of(yaml, item));
            changes.back().text = yaml_of(*edit.position_site_m);
        }
    }
    std::string result = changed(yaml, std::move(changes));
    check(result, edits);
    return result;
}

void merge_into(const std::string& path, const std::vector<AnchorEdit>& edits) {
    std::string error;
    const auto yaml = config::read_file(path, error);
    if (!yaml) throw std::runtime_error(path + ": " + error);
    replace_file(path, merged(*yaml, edits));
}

} // namespace locus::calibrate
