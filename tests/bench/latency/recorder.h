// Reads lines from a socket in a thread of its own and notes when each came. On a busy machine it must not be the one
// that waits, so it is scheduled as what it measures.
#pragma once

#include "daemon/realtime.h"
#include "drivers/clock.h"

#include <poll.h>
#include <sys/socket.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

namespace locus::bench {

struct TimedLine {
    Timestamp received{};
    std::string text;
};

class Recorder {
  public:
    Recorder(int fd, int priority)
        : thread_{[this, fd, priority](const std::stop_token& stop) {
              schedule_this_thread(priority);
              read(fd, stop);
          }} {}

    /// Ends the thread; call it once.
    std::vector<TimedLine> lines() {
        thread_.request_stop();
        thread_.join();
        return std::move(lines_);
    }

  private:
    void read(int fd, const std::stop_token& stop) {
        std::string buffer;
        char bytes[65536];
        while (!stop.stop_requested()) {
            pollfd waiting{fd, POLLIN, 0};
            if (::poll(&waiting, 1, 50) <= 0) continue;
            const ssize_t got = ::recv(fd, bytes, sizeof bytes, 0);
            const Timestamp received = monotonic_now();
            if (got <= 0) return;
            buffer.append(bytes, static_cast<std::size_t>(got));
            for (auto end = buffer.find('\n'); end != std::string::npos; end = buffer.find('\n')) {
                lines_.push_back({received, buffer.substr(0, end)});
                buffer.erase(0, end + 1);
            }
        }
    }

    std::vector<TimedLine> lines_;
    std::jthread thread_;
};

} // namespace locus::bench
