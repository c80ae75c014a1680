#include "tools/client/watching.h"

#include "tools/client/fields.h"

#include <fmt/format.h>

namespace locus::tools {

std::string watch_command(const WatchRequest& request) {
    nlohmann::json options{{"enable", true}};
    if (!request.targets.empty()) options["targets"] = request.targets;
    if (request.rate_hz) options["rate_hz"] = *request.rate_hz;
    if (request.readings) options["readings"] = true;
    std::string text = options.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
    // The first ';' ends the command, and in JSON it can only stand in a name.
    for (std::size_t at = 0; (at = text.find(';', at)) != std::string::npos;) text.replace(at, 1, "\\u003b");
    return "?WATCH=" + text + ";\n";
}

void start_watching(Client& client, const WatchRequest& request) {
    const Message answer = client.ask(watch_command(request), "WATCH");
    if (answer.class_name == "ERROR")
        throw DaemonError(fmt::format("locusd refuses to be watched: {}", text(answer.fields, "message")));
}

Deadline deadline_in(double seconds) {
    constexpr double a_century_s = 3.2e9;
    if (!(seconds < a_century_s)) return Deadline::max();
    return std::chrono::steady_clock::now() +
           std::chrono::duration_cast<Deadline::duration>(std::chrono::duration<double>(seconds));
}

} // namespace locus::tools
