// VectorNav (VN-100, VN-200, VN-300) on a serial line: binary output messages with any choice of fields, and the ASCII
// line $VNYMR that they send as they come (protocols.md 4.6). A message names its groups and their fields by bit masks;
// each field has a fixed length, so what we take is found whatever else there is.
#pragma once

#include "drivers/imu/mounting.h"
#include "drivers/wire/bytes.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace locus::imu {

/// What we take of a message, in its units.
struct VectorNavData {
    std::optional<std::uint64_t> time_startup_ns{};
    std::optional<Vec3> rate_radps{};
    std::optional<Vec3> acceleration_mps2{}; ///< specific force
    std::optional<Vec3> magnetic_gauss{};
    std::optional<double> pressure_kpa{};

    bool operator==(const VectorNavData&) const = default;
};

inline constexpr std::uint8_t vectornav_head = 0xFA;
inline constexpr std::size_t longest_vectornav_message = 1280; ///< every field of every group, and a little

/// Length of the binary message that begins with `bytes`; empty as long as not all its masks are there, 0 when it names
/// groups or fields that do not exist.
std::optional<std::size_t> vectornav_length(wire::Bytes bytes);
/// A whole binary message, its checksum already looked at. Group 0 (common) is read: its fields TimeStartup,
/// AngularRate and Accel, else Imu (not corrected), and MagPres.
VectorNavData parse_vectornav(wire::Bytes bytes);
/// A message of group 0 with these fields; magnetic field and pressure go together.
std::vector<std::uint8_t> encode(const VectorNavData& data);

/// "$VNYMR,...*XX" without the end of the line; empty when it is none, or its checksum is wrong.
std::optional<VectorNavData> parse_vnymr(std::string_view line);
/// With "\r\n"; what is not known goes as 0.
std::string encode_vnymr(const VectorNavData& data);

struct VectorNavSettings : MountingSettings {};
inline constexpr auto vectornav_options = mounting_options<VectorNavSettings>;

/// Gives an ImuSample per message or line that holds both halves, and a Pressure where there is one.
std::unique_ptr<Decoder> make_vectornav(const void* settings);

} // namespace locus::imu
