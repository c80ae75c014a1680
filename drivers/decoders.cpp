// The device families that a configuration can name.
#include "drivers/decoder.h"

#include <algorithm>
#include <array>

namespace locus {
namespace {
constexpr std::array<DecoderRow, 0> rows{};
}

std::span<const DecoderRow> decoder_table() { return rows; }

const DecoderRow* find_decoder(std::string_view name) {
    const auto table = decoder_table();
    const auto row = std::find_if(table.begin(), table.end(), [&](const DecoderRow& r) { return r.name == name; });
    return row == table.end() ? nullptr : &*row;
}

} // namespace locus
