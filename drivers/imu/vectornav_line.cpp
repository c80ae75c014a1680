// The line $VNYMR: yaw, pitch, roll, magnetic field, acceleration, rate.
#include "drivers/imu/vectornav.h"
#include "drivers/wire/checksum.h"

#include <fmt/format.h>

#include <charconv>

namespace locus::imu {
namespace {

constexpr std::string_view vnymr = "$VNYMR,";
constexpr std::size_t vnymr_numbers = 12;

/// The whole text as a number.
template <class T, class... Base>
bool read_number(std::string_view text, T& value, Base... base) {
    if (text.starts_with('+')) text.remove_prefix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base...);
    return error == std::errc{} && end == text.data() + text.size();
}

/// As many numbers as there is room for, with commas between, no more and no less.
bool read_numbers(std::string_view text, std::span<double> numbers) {
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::size_t comma = text.find(',');
        if ((comma == std::string_view::npos) != (i + 1 == numbers.size()) ||
            !read_number(text.substr(0, comma), numbers[i]))
            return false;
        text.remove_prefix(comma == std::string_view::npos ? text.size() : comma + 1);
    }
    return true;
}

} // namespace

std::optional<VectorNavData> parse_vnymr(std::string_view line) {
    const std::size_t star = line.find('*');
    if (!line.starts_with(vnymr) || star == std::string_view::npos) return std::nullopt;
    std::uint8_t checksum = 0;
    if (line.size() != star + 3 || !read_number(line.substr(star + 1), checksum, 16) ||
        checksum != wire::xor8(line.substr(1, star - 1)))
        return std::nullopt;
    std::array<double, vnymr_numbers> v{};
    if (!read_numbers(line.substr(vnymr.size(), star - vnymr.size()), v)) return std::nullopt;
    VectorNavData data;
    data.magnetic_gauss = {v[3], v[4], v[5]};
    data.acceleration_mps2 = {v[6], v[7], v[8]};
    data.rate_radps = {v[9], v[10], v[11]};
    return data;
}

std::string encode_vnymr(const VectorNavData& data) {
    const Vec3 m = data.magnetic_gauss.value_or(Vec3{}), a = data.acceleration_mps2.value_or(Vec3{}),
               w = data.rate_radps.value_or(Vec3{});
    const std::string line = fmt::format(
        "{}+000.000,+000.000,+000.000,{:+08.4f},{:+08.4f},{:+08.4f},{:+07.3f},{:+07.3f},{:+07.3f},{:+010.6f},"
        "{:+010.6f},{:+010.6f}",
        vnymr, m[0], m[1], m[2], a[0], a[1], a[2], w[0], w[1], w[2]);
    return fmt::format("{}*{:02X}\r\n", line, wire::xor8(std::string_view{line}.substr(1)));
}

} // namespace locus::imu
