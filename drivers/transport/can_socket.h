// A CAN_RAW socket on one interface, classic and FD frames: what the can transport reads and the simulator sends with.
#pragma once

#include "drivers/packet.h"
#include "drivers/transport/unique_fd.h"

#include <string>

namespace locus {

class CanSocket {
  public:
    /// False when there is no such interface, or it is down or off the bus; `error` says what to do.
    bool open(const std::string& interface, std::string& error);
    void close() { fd_.reset(); }
    /// Sends one frame; waits for at most 0.1 s while the interface's queue is full. False when it did not go out.
    bool send(const Packet& packet) const;
    int fd() const { return fd_.get(); }

  private:
    UniqueFd fd_;
};

} // namespace locus
