#include "drivers/gnss/rtcm3_messages.h"

#include "drivers/gnss/rtcm3_time.h"
#include "fusion/geometry/earth.h"

namespace locus::gnss::rtcm3 {
namespace {

constexpr std::size_t place_length = 19, place_with_height_length = 21;

double coordinate_m(Bits& bits) { return static_cast<double>(bits.take_signed(38)) * 1e-4; }

constexpr std::size_t gps_head_bits = 64, l1_bits = 74, l1_l2_bits = 125;

/// DF009 to DF015; DF011 in 0.02 m within the millisecond that DF014 counts.
std::optional<Signal> take_l1(Bits& bits) {
    constexpr std::uint64_t invalid = 0x80000, last_gps = 32;
    const auto satellite = bits.take(6);
    const bool precise_code = bits.take(1) != 0;
    const auto within_ms = bits.take(24);
    const auto whole_ms = bits.skip(20 + 7).take(8); // carrier and lock
    const auto quarter_dbhz = bits.take(8);
    if (precise_code || within_ms == invalid || satellite == 0 || satellite > last_gps) return std::nullopt;
    Signal signal;
    signal.satellite = static_cast<std::uint8_t>(satellite);
    signal.pseudorange_m = 0.02 * static_cast<double>(within_ms) + 1e-3 * light_mps * static_cast<double>(whole_ms);
    if (quarter_dbhz != 0) signal.carrier_to_noise_dbhz = 0.25F * static_cast<float>(quarter_dbhz);
    return signal;
}

} // namespace

std::optional<AntennaPlace> parse_place(wire::Bytes message) {
    const bool with_height = number_of(message) == 1006;
    if (message.size() != (with_height ? place_with_height_length : place_length)) return std::nullopt;
    Bits bits{message};
    AntennaPlace place;
    place.station = static_cast<std::uint16_t>(bits.skip(12).take(12));
    place.position_ecef_m[0] = coordinate_m(bits.skip(6 + 4));
    place.position_ecef_m[1] = coordinate_m(bits.skip(2));
    place.position_ecef_m[2] = coordinate_m(bits.skip(2));
    return place;
}

Reading parse_gps(wire::Bytes message) {
    Bits bits{message};
    if (bits.left() < gps_head_bits) return {{}, true};
    const std::size_t satellite_bits = bits.take(12) == 1002 ? l1_bits : l1_l2_bits;
    Epoch epoch;
    epoch.constellation = constellation::gps;
    epoch.station = static_cast<std::uint16_t>(bits.take(12));
    const auto time_s = gps_second(bits.take(30));
    const std::size_t satellites = bits.skip(1).take(5);
    bits.skip(4);
    if (bits.left() < satellites * satellite_bits) return {{}, true};
    if (!time_s) return {};
    epoch.time_s_in_gps_week = time_s.value();
    for (std::size_t i = 0; i < satellites; ++i) {
        const auto signal = take_l1(bits);
        bits.skip(satellite_bits - l1_bits);
        if (signal) epoch.signals[epoch.count++] = signal.value();
    }
    return {epoch, false};
}

} // namespace locus::gnss::rtcm3
