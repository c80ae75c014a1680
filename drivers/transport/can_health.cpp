#include "drivers/transport/can_health.h"

#include <linux/can.h>
#include <linux/can/error.h>

namespace locus {

void CanHealth::take(const Packet& error_frame) {
    ++error_frames_;
    const std::uint32_t what = error_frame.can_id & CAN_ERR_MASK;
    if ((what & CAN_ERR_CRTL) && error_frame.data.size() > 1) take_controller_state(error_frame.data[1]);
    if (what & CAN_ERR_RESTARTED) reset();
    if (what & CAN_ERR_ACK) {
        trouble_ = interface_ + " sends but nobody answers: is anything else on the bus, at the same bit rate?";
    }
    if (what & CAN_ERR_BUSOFF) {
        bus_off_ = true;
        trouble_ = interface_ + " went off the bus after too many errors (bus-off): check bit rate, wiring and "
                                "termination";
    }
}

void CanHealth::reset() {
    bus_off_ = false;
    trouble_.clear();
}

void CanHealth::take_controller_state(std::uint8_t bits) {
    if (bits & CAN_ERR_CRTL_ACTIVE) {
        trouble_.clear();
    } else if (bits & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE)) {
        trouble_ = interface_ + " is error passive (128 errors or more): check bit rate, wiring and termination";
    } else if (bits & (CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING)) {
        trouble_ = interface_ + " sees many errors (96 or more): check wiring and termination";
    } else if (bits & CAN_ERR_CRTL_RX_OVERFLOW) {
        trouble_ = interface_ + "'s controller lost frames: this computer did not fetch them in time";
    }
}

} // namespace locus
