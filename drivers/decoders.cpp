// The device families that a configuration can name.
#include "drivers/decoder.h"
#include "drivers/uwb/dw1000_can.h"
#include "drivers/uwb/dwm1001_shell.h"
#include "drivers/uwb/dwm1001_tlv.h"
#include "drivers/uwb/listener_json.h"
#include "drivers/uwb/navlab.h"
#include "drivers/uwb/nlink.h"
#include "drivers/uwb/pdoa_json.h"
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
    DecoderRow{"nlink", "Nooploop LinkTrack: ranges and IMU in NLink frames", Wire::bytes,
               option_table<uwb::NlinkSettings>(uwb::nlink_options), uwb::make_nlink},
    DecoderRow{"dwm1001_shell", "DWM1001 with PANS: distances that its shell prints (lec, les)", Wire::bytes,
               option_table<uwb::Dwm1001ShellSettings>(uwb::dwm1001_shell_options), uwb::make_dwm1001_shell},
    DecoderRow{"dwm1001_tlv", "DWM1001 with PANS: asked for its distances over UART", Wire::bytes,
               option_table<uwb::Dwm1001TlvSettings>(uwb::dwm1001_tlv_options), uwb::make_dwm1001_tlv},
    DecoderRow{"pdoa_json", "Decawave PDoA and TWR kits, Ai-Thinker BU03 and BU04: ranges as JSON lines", Wire::bytes,
               option_table<uwb::PdoaSettings>(uwb::pdoa_options), uwb::make_pdoa_json},
    DecoderRow{"navlab", "DW1000 nodes with Stanford NAV Lab's firmware: a line a range", Wire::bytes,
               option_table<uwb::NavlabSettings>({}), uwb::make_navlab},
    DecoderRow{"listener_json", "Decawave's listener: blinks and clock-calibration packets with their times",
               Wire::bytes, option_table<uwb::ListenerSettings>(uwb::listener_options), uwb::make_listener_json},
};
}

std::span<const DecoderRow> decoder_table() { return decoder_rows; }

const DecoderRow* find_decoder(std::string_view name) {
    const auto table = decoder_table();
    const auto row = std::find_if(table.begin(), table.end(), [&](const DecoderRow& r) { return r.name == name; });
    return row == table.end() ? nullptr : &*row;
}

} // namespace locus
