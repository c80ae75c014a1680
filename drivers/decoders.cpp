// The device families that a configuration can name.
#include "drivers/decoder.h"
#include "drivers/uwb/trek1000.h"

#include <algorithm>
#include <array>

namespace locus {
namespace {
constexpr std::array rows{
    DecoderRow{"trek1000", "Decawave TREK1000, EVK1000 and HaoruTech modules: ranges as ASCII lines", Wire::bytes,
               option_table<uwb::TrekSettings>(uwb::trek_options), uwb::make_trek1000},
};
}

std::span<const DecoderRow> decoder_table() { return rows; }

const DecoderRow* find_decoder(std::string_view name) {
    const auto table = decoder_table();
    const auto row = std::find_if(table.begin(), table.end(), [&](const DecoderRow& r) { return r.name == name; });
    return row == table.end() ? nullptr : &*row;
}

} // namespace locus
