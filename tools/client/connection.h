// The UNIX socket to the daemon: lines in, commands out, and a sentence for the person at the keyboard when it fails.
#pragma once

#include "drivers/transport/unique_fd.h"

#include <chrono>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace locus::tools {

/// what() is a whole sentence that says what is wrong and what to do.
class DaemonError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// There was a connection, and it is gone: the daemon may come back.
class ConnectionLost : public DaemonError {
    using DaemonError::DaemonError;
};

using Deadline = std::chrono::steady_clock::time_point;

class Connection {
  public:
    /// Longest line that is taken from the daemon: SOURCES of some ten thousand sources.
    static constexpr std::size_t max_line_bytes = std::size_t{8} << 20;

    /// Throws DaemonError when nothing listens at `path` or it may not be opened.
    explicit Connection(std::string path);

    /// Throws ConnectionLost when the daemon is gone or has not taken it within some seconds.
    void send(std::string_view text);

    /// The next line without its end; empty when none is whole at `deadline`. Throws ConnectionLost when the daemon has
    /// closed the connection, DaemonError when the line is too long.
    std::optional<std::string> read_line(Deadline deadline);

  private:
    std::optional<std::string> take_line();
    bool wait_readable(Deadline deadline) const;
    void fill();

    std::string path_;
    UniqueFd fd_;
    std::string buffer_;
    std::size_t begin_ = 0;   ///< start of the line under way
    std::size_t scanned_ = 0; ///< no line end before this
};

} // namespace locus::tools
