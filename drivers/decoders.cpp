// The device families that a configuration can name.
#include "drivers/decoder.h"
#include "drivers/gnss/nmea.h"
#include "drivers/gnss/ubx.h"
#include "drivers/uwb/dw1000_can.h"
#include "drivers/uwb/robomaster_can.h"
#include "drivers/uwb/trek1000.h"

#include <algorithm>
#include <array>

namespace locus {
namespace {
constexpr std::array decoder_rows{
    DecoderRow{"trek1000", "Decawave TREK1000, EVK1000 and HaoruTech modules: ranges as ASCII lines", Wire::bytes,
               option_table<uwb::TrekSettings>(uwb::trek_options), uwb::make_trek1000},
    DecoderRow{"dw1000_can", "DW1000 ranges and range differences over CAN (docs/can-dw1000.md)", Wire::can,
               option_table<uwb::Dw1000CanSettings>(uwb::dw1000_can_options), uwb::make_dw1000_can},
    DecoderRow{"robomaster_can", "DJI RoboMaster UWB tag module: six ranges over CAN", Wire::can,
               option_table<uwb::RobomasterSettings>(uwb::robomaster_options), uwb::make_robomaster_can},
    DecoderRow{"ubx", "u-blox GNSS receivers: fixes, raw measurements and navigation words in UBX", Wire::bytes,
               option_table<gnss::UbxSettings>(gnss::ubx_options), gnss::make_ubx},
    DecoderRow{"nmea", "GNSS receivers that talk NMEA 0183: one fix from GGA, RMC or VTG, and GST", Wire::bytes,
               option_table<gnss::NmeaSettings>(gnss::nmea_options), gnss::make_nmea},
};
}

std::span<const DecoderRow> decoder_table() { return decoder_rows; }

const DecoderRow* find_decoder(std::string_view name) {
    const auto table = decoder_table();
    const auto row = std::find_if(table.begin(), table.end(), [&](const DecoderRow& r) { return r.name == name; });
    return row == table.end() ? nullptr : &*row;
}

} // namespace locus
