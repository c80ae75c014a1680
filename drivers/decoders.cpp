// The device families that a configuration can name.
#include "drivers/decoder.h"
#include "drivers/gnss/nmea.h"
#include "drivers/gnss/rtcm3.h"
#include "drivers/gnss/ubx.h"
#include "drivers/imu/epson_g370.h"
#include "drivers/imu/vectornav.h"
#include "drivers/imu/witmotion.h"
#include "drivers/imu/xsens.h"
#include "drivers/imu/xsens_can.h"
#include "drivers/layout/can_layout.h"
#include "drivers/layout/serial_layout.h"
#include "drivers/radio/cc2531.h"
#include "drivers/radio/hm10.h"
#include "drivers/radio/xbee.h"
#include "drivers/radio/znp.h"
#include "drivers/slam/tum.h"
#include "drivers/uwb/apps_json.h"
#include "drivers/uwb/cwru_can.h"
#include "drivers/uwb/dw1000_can.h"
#include "drivers/uwb/dwm1001_shell.h"
#include "drivers/uwb/dwm1001_tlv.h"
#include "drivers/uwb/listener_json.h"
#include "drivers/uwb/loco_sniffer.h"
#include "drivers/uwb/navlab.h"
#include "drivers/uwb/nlink.h"
#include "drivers/uwb/pdoa_json.h"
#include "drivers/uwb/pulson/pulson.h"
#include "drivers/uwb/pulson/pulson_can.h"
#include "drivers/uwb/robomaster_can.h"
#include "drivers/uwb/trek1000.h"
#include "drivers/vehicle/obd2.h"

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
    DecoderRow{"cwru_can", "CWRU's DWM1000 nodes on CAN: ranges, asked for or not", Wire::can,
               option_table<uwb::CwruSettings>(uwb::cwru_options), uwb::make_cwru_can},
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
    DecoderRow{"apps_json", "Decawave's uwb-apps: ranges and range differences as JSON lines", Wire::bytes,
               option_table<uwb::AppsSettings>(uwb::apps_options), uwb::make_apps_json},
    DecoderRow{"loco_sniffer", "Bitcraze Loco node as a sniffer: range differences from TDoA2 and TDoA3", Wire::bytes,
               option_table<uwb::LocoSnifferSettings>(uwb::loco_sniffer_options), uwb::make_loco_sniffer},
    DecoderRow{"xbee", "Digi XBee in API mode: signal strength of other radios", Wire::bytes,
               option_table<radio::XbeeSettings>(radio::xbee_options), radio::make_xbee},
    DecoderRow{"znp", "TI Z-Stack network processor (CC2530, CC2652): link quality of other radios", Wire::bytes,
               option_table<radio::ZnpSettings>(radio::znp_options), radio::make_znp},
    DecoderRow{"cc2531", "TI CC2531 packet sniffer: signal strength of every 802.15.4 radio around", Wire::bytes,
               option_table<radio::Cc2531Settings>(radio::cc2531_options), radio::make_cc2531},
    DecoderRow{"hm10", "HM-10 and HM-17 BLE modules: iBeacons that they scan", Wire::bytes,
               option_table<radio::Hm10Settings>(radio::hm10_options), radio::make_hm10},
    DecoderRow{"obd2", "OBD-II over CAN: asks a vehicle for its speed and the barometric pressure", Wire::can,
               option_table<vehicle::Obd2Settings>(vehicle::obd2_options), vehicle::make_obd2},
    DecoderRow{"can_layout", "Any CAN frames, described here signal by signal as in a DBC file: vehicles, UWB",
               Wire::can,
               option_table<layout::CanLayoutSettings>(layout::can_layout_options, layout::can_layout_lists,
                                                       layout::check_can_layout),
               layout::make_can_layout},
    DecoderRow{"serial_layout", "Any binary frames of a serial line, described here field by field", Wire::bytes,
               option_table<layout::SerialLayoutSettings>(layout::serial_layout_options, layout::serial_layout_lists,
                                                          layout::check_serial_layout),
               layout::make_serial_layout},
    DecoderRow{"witmotion", "WitMotion inertial modules (JY901, WT901, HWT...) on a serial line", Wire::bytes,
               option_table<imu::WitMotionSettings>(imu::witmotion_options), imu::make_witmotion},
    DecoderRow{"witmotion_can", "WitMotion inertial modules on CAN", Wire::can,
               option_table<imu::WitMotionCanSettings>(imu::witmotion_can_options), imu::make_witmotion_can},
    DecoderRow{"xsens", "Xsens MTi inertial sensors on a serial line or USB (Xbus, MTData2)", Wire::bytes,
               option_table<imu::XsensSettings>(imu::xsens_options), imu::make_xsens},
    DecoderRow{"xsens_can", "Xsens MTi inertial sensors on CAN, with the identifiers they come with", Wire::can,
               option_table<imu::XsensCanSettings>(imu::xsens_can_options), imu::make_xsens_can},
    DecoderRow{"epson_g370", "Epson M-G370 inertial sensors on their UART, 460800 baud: bursts", Wire::bytes,
               option_table<imu::EpsonSettings>(imu::epson_options), imu::make_epson_g370},
    DecoderRow{"vectornav", "VectorNav VN-100, VN-200, VN-300 on a serial line: binary messages and $VNYMR",
               Wire::bytes, option_table<imu::VectorNavSettings>(imu::vectornav_options), imu::make_vectornav},
    DecoderRow{"pulson_usb", "PulsON P4xx radio over USB: RCM and RangeNet ranges", Wire::bytes,
               option_table<uwb::pulson::PulsonSettings>(uwb::pulson::stream_options, {}, uwb::pulson::check_pulson),
               uwb::pulson::make_usb},
    DecoderRow{"pulson_uart", "PulsON P4xx radio over its 3.3 V serial port: RCM and RangeNet ranges", Wire::bytes,
               option_table<uwb::pulson::PulsonSettings>(uwb::pulson::stream_options, {}, uwb::pulson::check_pulson),
               uwb::pulson::make_uart},
    DecoderRow{"pulson_udp", "PulsON P4xx radio over UDP: RCM and RangeNet ranges", Wire::bytes,
               option_table<uwb::pulson::PulsonSettings>(uwb::pulson::stream_options, {}, uwb::pulson::check_pulson),
               uwb::pulson::make_udp, true},
    DecoderRow{"pulson_can", "PulsON P440 radio over CAN (J1939): RCM and RangeNet ranges", Wire::can,
               option_table<uwb::pulson::PulsonSettings>(uwb::pulson::can_options), uwb::pulson::make_can},
    DecoderRow{"tum", "Poses of a SLAM or visual odometry as TUM lines: ORB-SLAM3, OpenVINS, VINS-Fusion", Wire::bytes,
               option_table<slam::TumSettings>(slam::tum_options), slam::make_tum},
    DecoderRow{"ubx", "u-blox GNSS receivers: fixes, raw measurements and navigation words in UBX", Wire::bytes,
               option_table<gnss::UbxSettings>(gnss::ubx_options), gnss::make_ubx},
    DecoderRow{"nmea", "GNSS receivers that talk NMEA 0183: one fix from GGA, RMC or VTG, and GST", Wire::bytes,
               option_table<gnss::NmeaSettings>(gnss::nmea_options), gnss::make_nmea},
    DecoderRow{"rtcm3", "GNSS base stations in RTCM 3: pseudoranges and their place, for differential corrections",
               Wire::bytes, option_table<gnss::Rtcm3Settings>({}), gnss::make_rtcm3},
};
}

std::span<const DecoderRow> decoder_table() { return decoder_rows; }

const DecoderRow* find_decoder(std::string_view name) {
    const auto table = decoder_table();
    const auto row = std::find_if(table.begin(), table.end(), [&](const DecoderRow& r) { return r.name == name; });
    return row == table.end() ? nullptr : &*row;
}

} // namespace locus
