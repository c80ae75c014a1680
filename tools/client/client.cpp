#include "tools/client/client.h"

#include "tools/client/fields.h"

#include <fmt/format.h>

namespace locus::tools {

namespace {

void require_locusd(const Message& greeting, const std::string& path) {
    if (greeting.class_name != "VERSION")
        throw DaemonError(fmt::format("{} is not locusd's socket: it greets with {}", path, greeting.class_name));
    const auto major = number(greeting.fields, "protocol_major").value_or(protocol_major);
    if (major != protocol_major)
        throw DaemonError(fmt::format("locusd speaks version {} of its protocol, this locus version {}: install the "
                                      "two from one release",
                                      major, protocol_major));
}

} // namespace

Message parse_message(std::string line) {
    constexpr std::size_t shown_bytes = 60;
    Message message{std::move(line), {}, {}};
    message.fields = nlohmann::json::parse(message.line, nullptr, false);
    if (message.fields.is_object()) message.class_name = text(message.fields, "class");
    if (message.class_name.empty())
        throw DaemonError(fmt::format("what answers is not locusd: \"{}\" is no line of its protocol",
                                      printable(message.line.substr(0, shown_bytes))));
    return message;
}

Client::Client(const std::string& path, std::chrono::milliseconds patience)
    : path_(path), connection_(path), patience_(patience) {
    take_greeting();
}

void Client::connect_again() {
    connection_ = Connection(path_);
    take_greeting();
}

void Client::take_greeting() {
    auto greeting = receive(std::chrono::steady_clock::now() + patience_);
    if (!greeting)
        throw DaemonError(fmt::format("{} does not answer: see `systemctl status locusd`, or name another socket with "
                                      "--socket",
                                      path_));
    require_locusd(*greeting, path_);
    version_ = std::move(*greeting);
}

std::optional<Message> Client::receive(Deadline deadline) {
    auto line = connection_.read_line(deadline);
    if (!line) return std::nullopt;
    return parse_message(std::move(*line));
}

Message Client::ask(std::string_view command, std::string_view answer) {
    send(command);
    const Deadline deadline = std::chrono::steady_clock::now() + patience_;
    while (auto message = receive(deadline))
        if (message->class_name == answer || message->class_name == "ERROR") return std::move(*message);
    throw DaemonError(fmt::format("locusd does not answer {} within {} s: see `systemctl status locusd`", command,
                                  std::chrono::duration<double>(patience_).count()));
}

} // namespace locus::tools
