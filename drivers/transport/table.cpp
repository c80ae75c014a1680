// The transports that a configuration can name.
#include "drivers/transport/transport.h"

#include <algorithm>
#include <array>

namespace locus {
namespace {
constexpr std::array<TransportRow, 0> rows{};
}

std::span<const TransportRow> transport_table() { return rows; }

const TransportRow* find_transport(std::string_view name) {
    const auto table = transport_table();
    const auto row = std::find_if(table.begin(), table.end(), [&](const TransportRow& r) { return r.name == name; });
    return row == table.end() ? nullptr : &*row;
}

} // namespace locus
