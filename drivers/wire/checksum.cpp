#include "drivers/wire/checksum.h"

#include <boost/crc.hpp>

#include <numeric>

namespace locus::wire {
namespace {
template <class Crc, class Sum = std::uint16_t>
Sum crc(Bytes bytes) {
    Crc crc;
    crc.process_bytes(bytes.data(), bytes.size());
    return static_cast<Sum>(crc.checksum());
}
} // namespace

std::uint8_t sum8(Bytes bytes) { return static_cast<std::uint8_t>(std::accumulate(bytes.begin(), bytes.end(), 0u)); }

std::uint8_t xor8(Bytes bytes) {
    return std::accumulate(bytes.begin(), bytes.end(), std::uint8_t{0},
                           [](std::uint8_t sum, std::uint8_t byte) { return static_cast<std::uint8_t>(sum ^ byte); });
}

std::uint8_t xor8(std::string_view text) { return xor8(bytes_of(text)); }

std::uint16_t sum16_big(Bytes bytes) {
    unsigned sum = 0;
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2) sum += big<std::uint16_t>(bytes, i);
    return static_cast<std::uint16_t>(sum);
}

std::uint16_t fletcher8(Bytes bytes) {
    std::uint8_t first = 0, second = 0;
    for (const std::uint8_t byte : bytes) {
        first = static_cast<std::uint8_t>(first + byte);
        second = static_cast<std::uint8_t>(second + first);
    }
    return static_cast<std::uint16_t>(first | second << 8);
}

std::uint16_t crc16_xmodem(Bytes bytes) { return crc<boost::crc_optimal<16, 0x1021, 0, 0, false, false>>(bytes); }
std::uint16_t crc16_kermit(Bytes bytes) { return crc<boost::crc_optimal<16, 0x1021, 0, 0, true, true>>(bytes); }
std::uint16_t crc16_modbus(Bytes bytes) { return crc<boost::crc_optimal<16, 0x8005, 0xFFFF, 0, true, true>>(bytes); }
std::uint32_t crc24q(Bytes bytes) {
    return crc<boost::crc_optimal<24, 0x864CFB, 0, 0, false, false>, std::uint32_t>(bytes);
}

} // namespace locus::wire
