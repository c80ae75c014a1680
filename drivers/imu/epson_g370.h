// Epson M-G370 on its UART: bursts whose fields the registers switch on and off (protocols.md 4.5). Nothing in a burst
// says which fields it has, so the settings must say what the device was told; with `configure` we tell it.
#pragma once

#include "drivers/imu/mounting.h"
#include "drivers/wire/bytes.h"

#include <optional>
#include <string>
#include <vector>

namespace locus::imu {

struct EpsonSettings : MountingSettings {
    std::string model = "G370PDF1";
    bool accel_16g = false;
    std::string rate_hz = "125";
    bool wide = true;
    bool flag = true;
    bool temperature = true;
    bool delta_angle = false;
    bool delta_velocity = false;
    bool gpio = false;
    bool count = true;
    bool configure = false;
};

inline constexpr std::array<std::string_view, 4> epson_models{"G370PDF1", "G370PDS0", "G370PDG0", "G370PDT0"};
inline constexpr std::array<std::string_view, 11> epson_rates_hz{"2000", "1000", "500", "400",  "250", "200",
                                                                 "125",  "100",  "80",  "62.5", "50"};

inline constexpr std::array epson_own_options{
    option<&EpsonSettings::model>("model", "Printed on its side; sets the scales.", epson_models),
    option<&EpsonSettings::accel_16g>("accel_16g",
                                      "Whether the accelerometer of a G370PDG0 or G370PDT0 is set to 16 g, not 8 g."),
    option<&EpsonSettings::rate_hz>("rate_hz", "Bursts a second.", epson_rates_hz),
    option<&EpsonSettings::wide>("wide", "Whether temperature, rates and accelerations have 32 bits, not 16."),
    option<&EpsonSettings::flag>("flag", "Whether bursts have the FLAG field."),
    option<&EpsonSettings::temperature>("temperature", "Whether bursts have the TEMP field."),
    option<&EpsonSettings::delta_angle>("delta_angle", "Whether bursts have angle increments; they are not used."),
    option<&EpsonSettings::delta_velocity>("delta_velocity",
                                           "Whether bursts have velocity increments; they are not used."),
    option<&EpsonSettings::gpio>("gpio", "Whether bursts have the GPIO field."),
    option<&EpsonSettings::count>("count", "Whether bursts have the COUNT field, which dates samples without jitter."),
    option<&EpsonSettings::configure>("configure",
                                      "Write the device's registers as the settings say, and start it, each time that "
                                      "it is opened or silent for three seconds. Its flash is not written."),
};
inline constexpr auto epson_options = joined(mounting_options<EpsonSettings>, epson_own_options);

/// A burst in the device's units; what it does not have is 0.
struct EpsonBurst {
    std::uint16_t flag = 0;
    std::int32_t temperature = 0;
    std::array<std::int32_t, 3> gyro{}, accel{};
    std::uint16_t gpio = 0, count = 0;

    bool operator==(const EpsonBurst&) const = default;
};

inline constexpr std::size_t longest_epson_burst = 1 + 2 + 4 + 4 * 12 + 2 + 2 + 2 + 1;

/// Bytes of a burst, from 0x80 to 0x0D.
std::size_t epson_burst_length(const EpsonSettings& settings);
/// A whole burst, its checksum already looked at.
EpsonBurst parse_epson_burst(wire::Bytes bytes, const EpsonSettings& settings);
std::vector<std::uint8_t> encode(const EpsonBurst& burst, const EpsonSettings& settings);

/// Gives an ImuSample per burst.
std::unique_ptr<Decoder> make_epson_g370(const void* settings);

} // namespace locus::imu
