#include "drivers/imu/epson_start.h"

#include <algorithm>

namespace locus::imu {
namespace {

struct EpsonRate {
    std::string_view rate_hz;
    std::uint8_t code;
    std::uint8_t filter; ///< the shortest moving average that the rate allows
};

/// Codes of SMPL_CTRL and FILTER_CTRL: Epson's public-domain driver (EPS), sensor_epsonG370PDF1.h.
constexpr std::array<EpsonRate, 11> epson_rate_codes{{{"2000", 0x00, 0},
                                                      {"1000", 0x01, 1},
                                                      {"500", 0x02, 2},
                                                      {"400", 0x08, 3},
                                                      {"250", 0x03, 3},
                                                      {"200", 0x09, 4},
                                                      {"125", 0x04, 4},
                                                      {"100", 0x0A, 5},
                                                      {"80", 0x0B, 5},
                                                      {"62.5", 0x05, 5},
                                                      {"50", 0x0C, 6}}};

constexpr EpsonCommand write_register(std::uint8_t address, unsigned value) {
    return {static_cast<std::uint8_t>(0x80 | address), static_cast<std::uint8_t>(value), 0x0D};
}
constexpr EpsonCommand window(unsigned number) { return write_register(0x7E, number); }

unsigned field_bits(const EpsonSettings& s) {
    return (s.flag ? 0x80u : 0) | (s.temperature ? 0x40u : 0) | 0x30u | (s.delta_velocity ? 0x08u : 0) |
           (s.delta_angle ? 0x04u : 0);
}

} // namespace

std::vector<EpsonCommand> epson_start_commands(const EpsonSettings& s) {
    const auto rate = std::ranges::find(epson_rate_codes, std::string_view{s.rate_hz}, &EpsonRate::rate_hz);
    const unsigned fields = field_bits(s);
    return {window(0),
            write_register(0x03, 2), // configuration mode
            window(1),
            write_register(0x05, rate->code),                      // SMPL_CTRL
            write_register(0x06, rate->filter),                    // FILTER_CTRL
            write_register(0x08, 1),                               // sends bursts by itself
            write_register(0x0C, 1u | s.count << 1 | s.gpio << 2), // checksum always
            write_register(0x0D, fields),                          // BURST_CTRL1
            write_register(0x0F, s.wide ? fields & 0x7Cu : 0),     // BURST_CTRL2: of 32 bits
            write_register(0x13, s.accel_16g),                     // DLT_CTRL: range
            window(0),
            write_register(0x03, 1)}; // sampling mode
}

std::optional<Packet> EpsonStart::request(Timestamp now) {
    if (next_ == commands_.size()) {
        if (heard_) last_ = now;
        heard_ = false;
        if (now - last_ < silence) return std::nullopt;
        next_ = 0;
    } else if (next_ > 0 && now - last_ < pause) {
        return std::nullopt;
    }
    last_ = now;
    Packet packet;
    packet.data = commands_[next_++];
    return packet;
}

} // namespace locus::imu
