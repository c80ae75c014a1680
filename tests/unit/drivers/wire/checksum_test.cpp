// Check values as the catalogue of CRC algorithms and protocols.md 0.4 have them.
#include "drivers/wire/checksum.h"

#include <gtest/gtest.h>

#include <string_view>

namespace locus::wire {
namespace {

Bytes bytes(std::string_view text) { return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}; }
const Bytes digits = bytes("123456789");

TEST(Checksum, Crc16) {
    EXPECT_EQ(crc16_xmodem(digits), 0x31C3);
    EXPECT_EQ(crc16_kermit(digits), 0x2189);
    EXPECT_EQ(crc16_modbus(digits), 0x4B37);
}

TEST(Checksum, Crc24) {
    EXPECT_EQ(crc24q(digits), 0xCDE703u);
    EXPECT_EQ(crc24q({}), 0u);
}

TEST(Checksum, Sums) {
    EXPECT_EQ(sum8(digits), 0xDD);
    EXPECT_EQ(xor8(digits), 0x31);
    EXPECT_EQ(sum16_big(bytes("\x12\x34\xff\xff\x77")), 0x1233);
    EXPECT_EQ(fletcher8(bytes(std::string_view{"\x01\x07\x00\x00", 4})), 0x1908) << "UBX poll of NAV-PVT";
}

TEST(Checksum, OfNothing) {
    EXPECT_EQ(sum8({}), 0);
    EXPECT_EQ(crc16_modbus({}), 0xFFFF);
}

} // namespace
} // namespace locus::wire
