// One row per transport, each written in its own file; table.cpp puts them together.
#pragma once

#include "drivers/transport/transport.h"

namespace locus {

TransportRow serial_row();
TransportRow pty_row();
TransportRow fifo_row();
TransportRow tcp_row();
TransportRow udp_row();
TransportRow can_row();
TransportRow recording_row();

} // namespace locus
