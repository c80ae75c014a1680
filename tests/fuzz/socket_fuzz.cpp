// Bytes from a client: whatever comes, the reader stays bounded and every answer is one line of JSON.
#include "daemon/socket/answers.h"
#include "daemon/socket/command.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstdlib>
#include <string>

namespace {

std::string answer(const locus::ParsedCommand& parsed) {
    if (const auto* bad = std::get_if<locus::BadCommand>(&parsed)) return locus::error_line(bad->message);
    const auto& watch = std::get<locus::Command>(parsed).watch;
    return locus::watch_line(watch.value_or(locus::Watch{}));
}

void check(const std::string& line) {
    const bool one_line = line.find('\n') == line.size() - 1;
    if (!one_line || !nlohmann::json::parse(line, nullptr, false).is_object()) std::abort();
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size == 0) return 0;
    const std::size_t step = 1 + data[0] * std::size_t{17}; // the first byte says how the stream is cut
    const std::string_view stream{reinterpret_cast<const char*>(data) + 1, size - 1};
    locus::CommandReader reader;
    for (std::size_t at = 0; at < stream.size(); at += step) {
        reader.feed(stream.substr(at, step));
        while (const auto parsed = reader.next()) check(answer(*parsed));
        if (reader.buffered() > locus::CommandReader::max_command) std::abort();
    }
    return 0;
}
