// The listening socket: handed over by systemd, or made here.
#pragma once

#include "drivers/transport/unique_fd.h"

#include <optional>
#include <string>

namespace locus {

class Listener {
  public:
    /// Binds `path`: mode 0660, so the process's group may read. A socket file that nobody listens at is replaced.
    /// Throws std::runtime_error with a sentence that says what to do.
    static Listener bind(const std::string& path);

    /// The socket that systemd hands over (sd_listen_fds); empty when there is none.
    /// Throws std::runtime_error when what was handed over is not one listening stream socket.
    static std::optional<Listener> inherit();

    Listener(Listener&& other) noexcept;
    Listener& operator=(Listener&&) = delete;
    /// Removes the socket file where bind() made it.
    ~Listener();

    int fd() const { return fd_.get(); }

  private:
    Listener(UniqueFd fd, std::string path);

    UniqueFd fd_;
    std::string path_; ///< empty: not ours to remove
};

} // namespace locus
