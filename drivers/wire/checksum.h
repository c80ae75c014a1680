// The checksums of protocols.md 0.4, one function each.
#pragma once

#include "drivers/wire/bytes.h"

#include <cstdint>
#include <string_view>

namespace locus::wire {

/// Sum of the bytes modulo 256 (NLink, WitMotion; its complement: XBee, Xsens).
std::uint8_t sum8(Bytes bytes);
/// Exclusive or of the bytes (NMEA, TI ZNP, VectorNav ASCII).
std::uint8_t xor8(Bytes bytes);
std::uint8_t xor8(std::string_view text);
/// Sum of big-endian 16-bit words modulo 65536, an odd last byte left out (Epson).
std::uint16_t sum16_big(Bytes bytes);
/// Fletcher's checksum in 8-bit arithmetic: first sum in the low byte, second in the high (UBX).
std::uint16_t fletcher8(Bytes bytes);
/// CRC-16 with polynomial 0x1021 from 0 (PulsON UART, VectorNav).
std::uint16_t crc16_xmodem(Bytes bytes);
/// CRC-16 with polynomial 0x1021 reflected, from 0 (IEEE 802.15.4 FCS).
std::uint16_t crc16_kermit(Bytes bytes);
/// CRC-16 with polynomial 0x8005 reflected, from 0xFFFF (Modbus).
std::uint16_t crc16_modbus(Bytes bytes);
/// CRC-24 with polynomial 0x864CFB from 0 (Qualcomm's CRC-24Q: RTCM 3).
std::uint32_t crc24q(Bytes bytes);

} // namespace locus::wire
