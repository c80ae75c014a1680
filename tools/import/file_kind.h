// What a file is, by what stands in it: names of such files end in anything.
#pragma once

#include <string>
#include <string_view>

namespace locus::importing {

enum class FileKind { rinex_observations, rinex_navigation, ubx, nmea, tum, measurements };

constexpr std::string_view kind_name(FileKind kind) {
    switch (kind) {
    case FileKind::rinex_observations:
        return "RINEX observations";
    case FileKind::rinex_navigation:
        return "RINEX navigation";
    case FileKind::ubx:
        return "UBX log";
    case FileKind::nmea:
        return "NMEA log";
    case FileKind::tum:
        return "TUM poses";
    case FileKind::measurements:
        return "recording of measurements";
    }
    return "";
}

/// Throws std::runtime_error with a sentence when the file cannot be read or is nothing of this.
FileKind kind_of_file(const std::string& path);

} // namespace locus::importing
