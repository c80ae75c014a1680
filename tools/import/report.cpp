#include "tools/import/report.h"

#include "tools/show/words.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <numeric>

namespace locus::importing {
namespace {

std::uint64_t measurements_of(const FileReport& report) {
    return std::accumulate(report.given.begin(), report.given.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const auto& named) { return sum + named.second; });
}

void append(std::vector<std::string>& lines, const FileReport& report) {
    lines.push_back(fmt::format("{}: {}", report.path, report.kind));
    for (const auto& [name, count] : report.given) lines.push_back(fmt::format("  {} {}", count, name));
    if (report.first)
        lines.push_back(fmt::format("  from {} to {} s of {}, {}", tools::figure(to_s(*report.first), 3),
                                    tools::figure(to_s(report.last), 3), report.clock,
                                    tools::duration(to_s(report.last - *report.first))));
    for (const auto& [why, count] : report.left_out) lines.push_back(fmt::format("  left out: {} {}", count, why));
    for (std::size_t i = 0; i < refusal_count; ++i)
        if (report.refused[i] > 0)
            lines.push_back(fmt::format("  {} times {} in a decoder", report.refused[i], refusal_names[i]));
    for (const auto& problem : report.problems) lines.push_back("  " + problem);
    if (report.bad > report.problems.size())
        lines.push_back(fmt::format("  and {} more", report.bad - report.problems.size()));
}

nlohmann::json as_json(const FileReport& report) {
    nlohmann::json object{{"path", report.path},
                          {"kind", report.kind},
                          {"bad_lines", report.bad},
                          {"problems", report.problems},
                          {"left_out", report.left_out}};
    object["measurements"] = nlohmann::json::object();
    for (const auto& [name, count] : report.given) object["measurements"][std::string(name)] = count;
    object["refused_by_decoders"] = nlohmann::json::object();
    for (std::size_t i = 0; i < refusal_count; ++i)
        if (report.refused[i] > 0) object["refused_by_decoders"][std::string(refusal_names[i])] = report.refused[i];
    if (report.first) {
        object["first"] = to_s(*report.first);
        object["last"] = to_s(report.last);
    }
    return object;
}

} // namespace

std::uint64_t measurements(const std::vector<FileReport>& reports) {
    return std::accumulate(reports.begin(), reports.end(), std::uint64_t{0},
                           [](std::uint64_t sum, const auto& report) { return sum + measurements_of(report); });
}

std::vector<std::string> report_lines(const std::vector<FileReport>& reports) {
    std::vector<std::string> lines;
    for (const auto& report : reports) append(lines, report);
    return lines;
}

std::string report_json(const std::vector<FileReport>& reports, const std::string& output) {
    nlohmann::json object{{"class", "IMPORT"}, {"output", output}, {"files", nlohmann::json::array()}};
    for (const auto& report : reports) object["files"].push_back(as_json(report));
    return object.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

} // namespace locus::importing
