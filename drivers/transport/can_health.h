// What the error frames of a CAN bus say, for a person: is the controller off the bus, is it struggling, how often did
// something go wrong (protocols.md 6.1; bits as in linux/can/error.h).
#pragma once

#include "drivers/packet.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace locus {

class CanHealth {
  public:
    explicit CanHealth(std::string interface) : interface_{std::move(interface)} {}

    /// One error frame (CAN_ERR_FLAG is set in its id).
    void take(const Packet& error_frame);
    /// The socket was opened anew: whatever was wrong is over; the count goes on.
    void reset();

    std::uint64_t error_frames() const { return error_frames_; }
    /// The controller has left the bus; nothing comes any more until it is restarted.
    bool bus_off() const { return bus_off_; }
    /// What is wrong now; empty when nothing is.
    std::string_view trouble() const { return trouble_; }

  private:
    void take_controller_state(std::uint8_t bits);

    const std::string interface_;
    std::uint64_t error_frames_ = 0;
    bool bus_off_ = false;
    std::string trouble_;
};

} // namespace locus
