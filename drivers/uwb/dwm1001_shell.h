// DWM1001 modules with Decawave's PANS, as their UART shell prints distances (protocols.md 1(b)), 115200 baud:
//
//   lec   DIST,1,AN0,2F2F,3.05,2.68,0.00,2.21,POS,1.59,1.65,1.27,44
//   les   1151[5.00,8.00,2.25]=6.48 le_us=2576 est[2.57,1.98,1.68,100]
//   lep   POS,2.57,2.00,1.67,97
//   apg   x:2570 y:2000 z:1670 qf:97
//
// lec and les give a Range to each anchor; the positions are the module's own and not used. There is no checksum and
// the module is known to lose characters, so whatever is not exactly as the firmware prints it is refused as a whole.
#pragma once

#include "drivers/decoder.h"
#include "drivers/uwb/list.h"

#include <optional>
#include <string>
#include <string_view>

namespace locus::uwb {

namespace dwm1001 {

using Hundredths = std::array<std::int64_t, 3>; ///< x, y, z in cm

struct Distance {
    std::uint16_t anchor = 0;
    Hundredths position_cm{};
    std::int64_t distance_cm = 0;

    bool operator==(const Distance&) const = default;
};

struct Position {
    Hundredths position_cm{};
    unsigned quality_percent = 0;

    bool operator==(const Position&) const = default;
};

struct ShellLine {
    enum class Kind : std::uint8_t { lec, les, position };
    static constexpr std::size_t max_distances = 16;

    Kind kind = Kind::lec;
    List<Distance, max_distances> distances;
    std::uint32_t solver_us = 0; ///< les
    std::optional<Position> position;

    bool operator==(const ShellLine&) const = default;
};

/// One line without its end; `position` stands for lep and apg. Empty when it is not exactly one.
std::optional<ShellLine> parse_shell_line(std::string_view text);

/// As the firmware prints it (`position` as lep does), with "\r\n".
std::string encode(const ShellLine& line);

} // namespace dwm1001

struct Dwm1001ShellSettings {
    Address tag = address(0);
    bool start_stream = false;
};

inline constexpr std::array dwm1001_shell_options{
    required_option<&Dwm1001ShellSettings::tag>("tag", "Address of the module, which does not tell its own."),
    option<&Dwm1001ShellSettings::start_stream>(
        "start_stream", "Enter the shell and send `lec` when the module has been silent for two seconds."),
};

std::unique_ptr<Decoder> make_dwm1001_shell(const void* settings);

} // namespace locus::uwb
