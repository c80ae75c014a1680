#include "tools/import/file_kind.h"

#include "drivers/gnss/nmea_sentence.h"
#include "drivers/gnss/rinex_text.h"
#include "drivers/gnss/ubx_frame.h"
#include "drivers/recording/measurement_json.h"
#include "drivers/slam/tum.h"
#include "tools/import/lines.h"

#include <fmt/format.h>

#include <stdexcept>
#include <vector>

namespace locus::importing {
namespace {

constexpr std::size_t looked_at = 65536; ///< bytes; a receiver says something good in so many

std::vector<std::uint8_t> begin_of(const std::string& path) {
    std::ifstream file = opened(path);
    std::vector<std::uint8_t> bytes(looked_at);
    file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
}

[[noreturn]] void refuse(const std::string& path, std::string_view why) {
    throw std::runtime_error(fmt::format("'{}' {}", path, why));
}

FileKind rinex_kind(const std::string& path, const gnss::rinex::Kind& kind) {
    if (kind.version >= 4) refuse(path, "is RINEX 4; versions up to 3 are read: ask for those, or convert it");
    if (kind.type == 'N' || kind.type == 'G') return FileKind::rinex_navigation;
    if (kind.type != 'O') refuse(path, "is RINEX, but neither observations nor navigation");
    if (kind.version < 3)
        refuse(path, "holds observations of RINEX 2; convert it: convbin -r rinex -v 3.04 -o NEW.obs FILE");
    return FileKind::rinex_observations;
}

bool has_ubx_frame(std::span<const std::uint8_t> bytes) {
    const gnss::ubx::Format format;
    for (; !bytes.empty(); bytes = bytes.subspan(1))
        if (format.look(bytes).kind == Look::Kind::frame) return true;
    return false;
}

bool has_sentence(std::string_view text) {
    while (!text.empty()) {
        std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        if (line.ends_with('\r')) line.remove_suffix(1);
        const auto parsed = gnss::nmea::parse_sentence(line, true);
        if (std::holds_alternative<gnss::nmea::Sentence>(parsed)) return true;
    }
    return false;
}

/// The first line that says anything.
std::string_view first_said(std::string_view text) {
    while (!text.empty()) {
        std::string_view line = text.substr(0, text.find('\n'));
        text.remove_prefix(std::min(line.size() + 1, text.size()));
        if (line.ends_with('\r')) line.remove_suffix(1);
        if (!line.empty() && line.front() != '#') return line;
    }
    return {};
}

bool is_pose(std::string_view line) {
    const auto pose = slam::parse_tum_pose(line);
    return pose && slam::is_usable(*pose);
}

bool is_measurement(std::string_view line) {
    std::string error;
    return from_json_line(line, error).has_value();
}

} // namespace

FileKind kind_of_file(const std::string& path) {
    const auto bytes = begin_of(path);
    const std::string_view text{reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    const std::string_view first_line = text.substr(0, text.find_first_of("\r\n"));
    if (const auto kind = gnss::rinex::kind_of(first_line)) return rinex_kind(path, *kind);
    if (gnss::rinex::label(first_line).starts_with("CRINEX"))
        refuse(path, "is packed by Hatanaka's method: unpack it with crx2rnx first");
    if (text.starts_with("\x1f\x8b")) refuse(path, "is packed: unpack it with gunzip first");
    if (has_ubx_frame(bytes)) return FileKind::ubx;
    if (has_sentence(text)) return FileKind::nmea;
    if (is_pose(first_said(text))) return FileKind::tum;
    if (is_measurement(first_said(text))) return FileKind::measurements;
    refuse(path, "is neither RINEX nor a log of UBX or NMEA, nor TUM poses, nor a recording of measurements");
}

} // namespace locus::importing
