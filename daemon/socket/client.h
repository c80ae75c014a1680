// One connection: what it asked for, what waits for it, and how much of it the socket takes.
#pragma once

#include "daemon/socket/command.h"
#include "daemon/socket/line_queue.h"
#include "drivers/transport/unique_fd.h"

#include <cstdint>
#include <optional>

namespace locus {

class Client {
  public:
    /// `fd`: a connected, non-blocking stream socket.
    Client(UniqueFd fd, std::size_t max_poses) : queue{max_poses}, fd_{std::move(fd)} {}

    /// Takes in what has come, a bounded piece at a time. False: the connection is broken.
    bool receive();

    /// The next command; empty when there is none, or when too many answers wait to be read.
    std::optional<ParsedCommand> next_command();

    /// Writes what the socket takes now. False: the other side is gone.
    bool flush();

    /// The epoll events that matter now.
    std::uint32_t interest() const;

    /// Root and the daemon's own user may change things (SO_PEERCRED).
    bool may_change() const;

    int fd() const { return fd_.get(); }

    LineQueue queue;
    Watch watch;
    std::uint32_t armed = 0; ///< events that epoll was told last

  private:
    bool is_listened_to() const { return queue.answers() < max_waiting_answers; }

    static constexpr std::size_t max_waiting_answers = 8;
    UniqueFd fd_;
    CommandReader reader_;
    bool said_all_ = false; ///< the other side will send nothing more
};

} // namespace locus
