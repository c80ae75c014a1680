// The floor: a process that reads a terminal and writes every chunk to one socket client, and nothing else; scheduled
// as the daemon's threads are.
#pragma once

#include "daemon/realtime.h"
#include "drivers/transport/unique_fd.h"

#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <string>

namespace locus::bench {

class BareCopy {
  public:
    BareCopy(const std::string& device, const std::string& socket_path, int priority) : pid_{::fork()} {
        if (pid_ != 0) return;
        schedule_this_thread(priority);
        ::_exit(copy(device, socket_path));
    }
    ~BareCopy() {
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
    }
    BareCopy(const BareCopy&) = delete;
    BareCopy& operator=(const BareCopy&) = delete;

  private:
    static int copy(const std::string& device, const std::string& socket_path) {
        const UniqueFd from{::open(device.c_str(), O_RDWR | O_NOCTTY)};
        termios terminal{};
        ::tcgetattr(from.get(), &terminal);
        ::cfmakeraw(&terminal);
        ::tcsetattr(from.get(), TCSANOW, &terminal);
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        std::ranges::copy(socket_path, address.sun_path);
        const UniqueFd listener{::socket(AF_UNIX, SOCK_STREAM, 0)};
        ::bind(listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address);
        ::listen(listener.get(), 1);
        const UniqueFd to{::accept(listener.get(), nullptr, nullptr)};
        char bytes[4096];
        for (ssize_t got = 1; got > 0;) {
            got = ::read(from.get(), bytes, sizeof bytes);
            if (got > 0 && ::write(to.get(), bytes, static_cast<std::size_t>(got)) != got) return 1;
        }
        return 0;
    }

    pid_t pid_;
};

} // namespace locus::bench
