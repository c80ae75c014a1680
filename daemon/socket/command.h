// Commands of the socket: bytes -> commands. Pure, bounded, and forgiving: what cannot be understood becomes a sentence
// for the client and never ends the connection.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace locus {

/// What one client wants to be sent. The default is what a fresh connection has: nothing.
struct Watch {
    bool enable = false;
    bool poses = true;
    bool smoothed = false;            ///< also those of fusion.smooth_lag_s ago
    bool readings = false;            ///< also what radios heard
    double rate_hz = 0;               ///< poses of one target per second at most; 0: all
    std::vector<std::string> targets; ///< by name; empty: all

    bool wants(std::string_view target) const;
    bool wants_smoothed(std::string_view target) const;
    bool wants_readings(std::string_view target) const;
    bool operator==(const Watch&) const = default;
};

enum class Verb { watch, poll, sources, targets, status, reload, view };

struct Command {
    Verb verb = Verb::status;
    std::optional<Watch> watch{}; ///< of ?WATCH={...}; empty: only asks what is in force
    std::string camera{};         ///< of ?VIEW={...}
};

struct BadCommand {
    std::string message; ///< a sentence for the client
};

using ParsedCommand = std::variant<Command, BadCommand>;

/// One command without its ';', e.g. `?WATCH={"enable":true}`.
ParsedCommand parse_command(std::string_view text);

/// Cuts a stream of bytes into commands. Holds at most max_command bytes of one that is not finished, and whatever was
/// fed beside it; what is longer is thrown away up to its ';' and answered once.
class CommandReader {
  public:
    static constexpr std::size_t max_command = 4096;

    void feed(std::string_view bytes) { buffer_.append(bytes); }

    /// The next whole command, parsed; empty when there is none.
    std::optional<ParsedCommand> next();

    bool has_whole_command() const { return buffer_.find(';') != std::string::npos; }
    std::size_t buffered() const { return buffer_.size(); }

  private:
    std::optional<ParsedCommand> give_up_on_this_one();

    std::string buffer_;
    bool skipping_ = false;
};

} // namespace locus
