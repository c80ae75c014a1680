// Client: what the commands say to the daemon and hear from it, by docs/protocol.md.
#pragma once

#include "tools/client/connection.h"

#include <nlohmann/json.hpp>

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

namespace locus::tools {

inline constexpr int protocol_major = 1;

/// One line of the daemon.
struct Message {
    std::string line;       ///< as it came, without its end
    std::string class_name; ///< "POSE", "STATUS", ...
    nlohmann::json fields;  ///< always an object
};

class Client {
  public:
    /// Connects and reads the greeting. Throws DaemonError, also when something else than locusd answers.
    explicit Client(const std::string& path, std::chrono::milliseconds patience = std::chrono::seconds{5});

    /// A new connection in place of the lost one. Throws DaemonError as the constructor does.
    void connect_again();

    const Message& version() const { return version_; }

    void send(std::string_view command) { connection_.send(command); }

    /// The next line whatever its class; empty when none came until `deadline`. Throws DaemonError when the connection
    /// ended or the line is not of the protocol.
    std::optional<Message> receive(Deadline deadline);

    /// Sends `command` and returns the next line of class `answer` or "ERROR"; lines of other classes are passed over.
    /// Throws DaemonError when it does not come in time.
    Message ask(std::string_view command, std::string_view answer);

  private:
    void take_greeting();

    std::string path_;
    Connection connection_;
    std::chrono::milliseconds patience_;
    Message version_;
};

/// The line as a message. Throws DaemonError when it is not a JSON object with a class.
Message parse_message(std::string line);

} // namespace locus::tools
