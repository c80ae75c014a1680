#include "drivers/gnss/rinex_signal.h"

#include "fusion/gnss/beidou_d1.h"
#include "fusion/measurement.h"

#include <algorithm>
#include <array>

namespace locus::gnss::rinex {
namespace {

struct SignalName {
    std::uint8_t constellation;
    std::string_view code;
    std::uint8_t signal;
    std::uint8_t signal_geostationary;
};

constexpr SignalName same(std::uint8_t constellation, std::string_view code, std::uint8_t signal) {
    return {constellation, code, signal, signal};
}

// RINEX 3.02 calls B1I "1I"; before and after it is "2I".
constexpr std::array names{
    same(constellation::gps, "1C", 0),
    same(constellation::gps, "2L", 3),
    same(constellation::gps, "2X", 3),
    same(constellation::gps, "2S", 4),
    same(constellation::gps, "5I", 6),
    same(constellation::gps, "5Q", 7),
    same(constellation::gps, "5X", 7),
    same(constellation::sbas, "1C", 0),
    same(constellation::galileo, "1C", 0),
    same(constellation::galileo, "1X", 0),
    same(constellation::galileo, "1B", 1),
    same(constellation::galileo, "5I", 3),
    same(constellation::galileo, "5Q", 4),
    same(constellation::galileo, "5X", 4),
    same(constellation::galileo, "7I", 5),
    same(constellation::galileo, "7Q", 6),
    same(constellation::galileo, "7X", 6),
    SignalName{constellation::beidou, "2I", 0, 1},
    SignalName{constellation::beidou, "1I", 0, 1},
    SignalName{constellation::beidou, "7I", 2, 3},
    SignalName{constellation::beidou, "6I", 4, 10},
    same(constellation::beidou, "1P", 5),
    same(constellation::beidou, "1X", 5),
    same(constellation::beidou, "1D", 6),
    same(constellation::beidou, "5P", 7),
    same(constellation::beidou, "5X", 7),
    same(constellation::beidou, "5D", 8),
    same(constellation::qzss, "1C", 0),
    same(constellation::qzss, "1Z", 1),
    same(constellation::qzss, "2S", 4),
    same(constellation::qzss, "2L", 5),
    same(constellation::qzss, "2X", 5),
    same(constellation::qzss, "5I", 8),
    same(constellation::qzss, "5Q", 9),
    same(constellation::qzss, "5X", 9),
    same(constellation::glonass, "1C", 0),
    same(constellation::glonass, "2C", 2),
};

} // namespace

std::optional<std::uint8_t> signal_of(std::uint8_t constellation, std::uint8_t satellite,
                                      std::string_view band_and_attribute) {
    const auto* found = std::ranges::find_if(names, [&](const SignalName& name) {
        return name.constellation == constellation && name.code == band_and_attribute;
    });
    if (found == names.end()) return std::nullopt;
    return beidou_geostationary(satellite) ? found->signal_geostationary : found->signal;
}

} // namespace locus::gnss::rinex
