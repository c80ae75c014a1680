// The transports that a configuration can name.
#include "drivers/transport/rows.h"

#include <algorithm>
#include <array>

namespace locus {

std::span<const TransportRow> transport_table() {
    static const std::array rows{serial_row(), pty_row(), fifo_row(), tcp_row(), udp_row(), can_row(), recording_row()};
    return rows;
}

const TransportRow* find_transport(std::string_view name) {
    const auto table = transport_table();
    const auto row = std::find_if(table.begin(), table.end(), [&](const TransportRow& r) { return r.name == name; });
    return row == table.end() ? nullptr : &*row;
}

} // namespace locus
