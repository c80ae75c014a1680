#include "tools/show/pose_panel.h"

#include "tools/client/fields.h"
#include "tools/show/table.h"
#include "tools/show/words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace locus::tools {

using nlohmann::json;

namespace {

struct PoseWords {
    std::string x, y, z, speed, horizontal, vertical;
};

PoseWords words(const json& pose) {
    const auto position = vector3(pose, "position_site_m"), velocity = vector3(pose, "velocity_site_mps");
    const auto along = [&](std::size_t axis) { return position ? figure((*position)[axis], 3) : "-"; };
    return {along(0),
            along(1),
            along(2),
            velocity ? figure(std::hypot((*velocity)[0], (*velocity)[1], (*velocity)[2]), 2) : "-",
            figure(number(pose, "horizontal_error_95_m"), 2),
            figure(number(pose, "vertical_error_95_m"), 2)};
}

std::string kinds(const json& pose) {
    std::vector<std::string> names;
    for (const auto& kind : list(pose, "kinds_used"))
        if (kind.is_string()) names.push_back(printable(kind.get_ref<const std::string&>()));
    return fmt::format("{}", fmt::join(names, " "));
}

std::optional<double> age(const json& pose, double now_s) {
    const auto time = number(pose, "time");
    return time ? std::optional{now_s - *time} : std::nullopt;
}

std::vector<std::string> cells(const std::string& name, const json& pose, double now_s) {
    const PoseWords w = words(pose);
    return {name,
            w.x,
            w.y,
            w.z,
            w.horizontal,
            w.vertical,
            w.speed,
            duration(age(pose, now_s)),
            figure(number(pose, "reset_count"), 0),
            kinds(pose)};
}

} // namespace

PosePanel::PosePanel(const Message& version, std::vector<std::string> only)
    : title_(fmt::format("locusd {}, site {}", text(version.fields, "release"), text(version.fields, "site"))),
      only_(std::move(only)) {}

bool PosePanel::wanted(const std::string& name) const {
    return only_.empty() || std::ranges::find(only_, name) != only_.end();
}

void PosePanel::take(const Message& message) {
    if (message.class_name == "TARGETS") take_targets(list(message.fields, "targets"));
    if (message.class_name == "POSE") rows_[text(message.fields, "target")] = {message.fields, ""};
}

void PosePanel::take_targets(const json& targets) {
    std::set<std::string> present;
    for (const auto& target : targets) {
        const std::string name = text(target, "name");
        if (!wanted(name)) continue;
        present.insert(name);
        rows_[name].missing = flag(target, "has_pose") ? "" : text(target, "missing");
    }
    std::erase_if(rows_, [&](const auto& row) { return !present.contains(row.first); });
}

std::vector<std::string> PosePanel::lines(double now_s) const {
    Table table({{"target"},
                 {"x m", Align::right, 8},
                 {"y m", Align::right, 8},
                 {"z m", Align::right, 7},
                 {"±95 % m", Align::right},
                 {"±z m", Align::right, 5},
                 {"m/s", Align::right, 5},
                 {"age", Align::right, 6},
                 {"resets", Align::right},
                 {"from"}});
    for (const auto& [name, row] : rows_)
        table.add(row.missing.empty() ? cells(name, row.pose, now_s) : std::vector{name, row.missing});
    if (rows_.empty()) table.add({"no target yet: `locus status` says what is missing"});
    auto result = table.lines();
    result.insert(result.begin(), title_);
    return result;
}

std::string pose_line(const json& pose) {
    const PoseWords w = words(pose);
    return fmt::format("{} {}  x {:>8}  y {:>8}  z {:>7}  ±95 % {:>5} m, ±z {:>5} m  {:>5} m/s  {}",
                       figure(number(pose, "time"), 3), text(pose, "target"), w.x, w.y, w.z, w.horizontal, w.vertical,
                       w.speed, kinds(pose));
}

} // namespace locus::tools
