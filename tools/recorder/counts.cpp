#include "tools/recorder/counts.h"

#include "tools/show/table.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <numeric>

namespace locus::tools {
namespace {

std::uint64_t refused(const InputStatus& status) {
    return std::accumulate(status.refused.begin(), status.refused.end(), std::uint64_t{0});
}

} // namespace

void print_counts(const RecordSession& session) {
    Table table{{{"input"},
                 {"packets", Align::right},
                 {"bytes", Align::right},
                 {"frames", Align::right},
                 {"measurements", Align::right},
                 {"refused", Align::right},
                 {"lost in kernel", Align::right}}};
    for (const auto& part : session.parts()) {
        const InputStatus& status = part->input.status();
        table.add({part->input.name(), fmt::to_string(status.packets.load()), fmt::to_string(status.bytes.load()),
                   fmt::to_string(status.frames.load()), fmt::to_string(status.measurements.load()),
                   fmt::to_string(refused(status)), fmt::to_string(status.kernel_dropped.load())});
    }
    for (const auto& line : table.lines()) fmt::print("{}\n", line);
}

void print_counts_json(const RecordSession& session, const std::string& output) {
    nlohmann::json inputs = nlohmann::json::array();
    for (const auto& part : session.parts()) {
        const InputStatus& status = part->input.status();
        inputs.push_back({{"name", part->input.name()},
                          {"packets", status.packets.load()},
                          {"bytes", status.bytes.load()},
                          {"frames", status.frames.load()},
                          {"measurements", status.measurements.load()},
                          {"refused", refused(status)},
                          {"kernel_dropped", status.kernel_dropped.load()},
                          {"reconnects", status.reconnects.load()}});
    }
    fmt::print("{}\n", nlohmann::json{{"file", output}, {"inputs", inputs}}.dump());
}

} // namespace locus::tools
