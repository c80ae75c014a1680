// The summary of a replay, for people and for programs.
#include "tools/replay/replay.h"
#include "tools/show/table.h"
#include "tools/show/words.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace locus::replay {
namespace {

using tools::Align;
using tools::Table;

double span_s(const Summary& summary) {
    return summary.first_arrival ? to_s(summary.last_arrival - *summary.first_arrival) : 0;
}

void append_reading(std::vector<std::string>& lines, const ReadReport& read) {
    for (const auto& problem : read.problems) lines.push_back("  " + problem);
    if (read.bad_lines > read.problems.size())
        lines.push_back(fmt::format("  and {} more", read.bad_lines - read.problems.size()));
    for (const auto& [input, count] : read.lines_of_unknown_inputs)
        lines.push_back(fmt::format("  {} lines of '{}' left out: no enabled input has this name", count, input));
    for (std::size_t i = 0; i < refusal_count; ++i)
        if (read.refused[i] > 0)
            lines.push_back(fmt::format("  {} times {} in a decoder", read.refused[i], refusal_names[i]));
}

Table verdict_table(const EngineCounters& engine) {
    Table table{{{"measurements", Align::right}, {"verdict"}, {"which means"}}};
    for (std::size_t i = 0; i < exclusion_count; ++i)
        if (engine.by_reason[i] > 0)
            table.add({std::to_string(engine.by_reason[i]), std::string(exclusion_texts[i].name),
                       std::string(exclusion_texts[i].sentence)});
    return table;
}

Table target_table(const Summary& summary) {
    Table table{{{"target"}, {"poses", Align::right}, {"from s", Align::right}, {"to s", Align::right}, {"missing"}}};
    for (const auto& [name, target] : summary.targets) {
        const bool any = target.poses > 0;
        const auto time = [&](Timestamp t) { return any ? tools::figure(to_s(t), 3) : "-"; };
        const bool well = target.missing == Missing::nothing;
        table.add({name, std::to_string(target.poses), time(target.first), time(target.last),
                   well ? "" : std::string(missing_sentence(target.missing))});
    }
    return table;
}

/// Those that were not well at the end.
Table anchor_table(const Summary& summary) {
    Table table{{{"anchor"}, {"state"}, {"off m", Align::right}, {"moved m", Align::right}, {"which means"}}};
    const auto known = [](float value) { return std::isfinite(value) ? std::optional<double>(value) : std::nullopt; };
    for (const auto& [name, health] : summary.anchors)
        if (health.state != AnchorState::good && health.state != AnchorState::joined)
            table.add({name, std::string(anchor_state_name(health.state)), tools::figure(known(health.residual_m), 2),
                       tools::figure(known(health.moved_m), 2), std::string(anchor_state_sentence(health.state))});
    return table;
}

void append(std::vector<std::string>& lines, const Table& table) {
    if (table.empty()) return;
    lines.emplace_back();
    for (auto& line : table.lines()) lines.push_back(std::move(line));
}

nlohmann::json by_name(const EngineCounters& engine) {
    nlohmann::json counts = nlohmann::json::object();
    for (std::size_t i = 0; i < exclusion_count; ++i)
        if (engine.by_reason[i] > 0) counts[std::string(exclusion_texts[i].name)] = engine.by_reason[i];
    return counts;
}

nlohmann::json by_refusal(const ReadReport& read) {
    nlohmann::json counts = nlohmann::json::object();
    for (std::size_t i = 0; i < refusal_count; ++i)
        if (read.refused[i] > 0) counts[std::string(refusal_names[i])] = read.refused[i];
    return counts;
}

nlohmann::json as_json(const std::string& name, const Summary::Target& target) {
    nlohmann::json object{{"name", name}, {"poses", target.poses}};
    if (target.poses > 0) {
        object["first"] = to_s(target.first);
        object["last"] = to_s(target.last);
    }
    if (target.missing != Missing::nothing) object["missing"] = missing_sentence(target.missing);
    return object;
}

} // namespace

std::vector<std::string> summary_lines(const Summary& summary) {
    std::vector<std::string> lines{fmt::format("{} of recording, {} lines, {} bad", tools::duration(span_s(summary)),
                                               summary.read.lines, summary.read.bad_lines)};
    append_reading(lines, summary.read);
    if (summary.one_way > 0)
        lines.push_back(fmt::format("{} measurements cannot be run backwards and are not smoothed", summary.one_way));
    append(lines, verdict_table(summary.engine));
    append(lines, target_table(summary));
    append(lines, anchor_table(summary));
    return lines;
}

std::string summary_json(const Summary& summary) {
    nlohmann::json object{{"class", "REPLAY"},
                          {"span_s", span_s(summary)},
                          {"lines", summary.read.lines},
                          {"bad_lines", summary.read.bad_lines},
                          {"problems", summary.read.problems},
                          {"lines_of_unknown_inputs", summary.read.lines_of_unknown_inputs},
                          {"refused_by_decoders", by_refusal(summary.read)},
                          {"measurements", summary.engine.received},
                          {"one_way", summary.one_way},
                          {"verdicts", by_name(summary.engine)},
                          {"rolled_back", summary.engine.rolled_back},
                          {"targets", nlohmann::json::array()}};
    for (const auto& [name, target] : summary.targets) object["targets"].push_back(as_json(name, target));
    for (const auto& [name, health] : summary.anchors) object["anchors"][name] = anchor_state_name(health.state);
    return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::vector<std::string> what_is_missing(const Summary& summary) {
    if (summary.engine.received == 0) return {"there is no measurement in it"};
    std::vector<std::string> sentences;
    for (const auto& [name, target] : summary.targets)
        sentences.push_back(name + ": " + std::string(missing_sentence(target.missing)));
    if (sentences.empty()) sentences.emplace_back("no measurement is of a target that is followed");
    return sentences;
}

} // namespace locus::replay
