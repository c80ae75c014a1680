#include "tools/show/words.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace locus::tools {

std::string figure(std::optional<double> value, int decimals) {
    return value ? fmt::format("{:.{}f}", *value, decimals) : "-";
}

std::string duration(std::optional<double> seconds) {
    constexpr double a_minute = 60, a_century = 3.2e9;
    if (!seconds || !(std::abs(*seconds) < a_century)) return "-";
    if (std::abs(*seconds) < 0.9995) return fmt::format("{:.0f} ms", *seconds * 1e3);
    if (*seconds < a_minute) return fmt::format("{:.1f} s", *seconds);
    const auto whole = static_cast<std::int64_t>(*seconds);
    if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
    if (whole < 86400) return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
    return fmt::format("{} d {} h", whole / 86400, whole / 3600 % 24);
}

} // namespace locus::tools
