#include "drivers/gnss/rinex_text.h"

#include "fusion/measurement.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace locus::gnss::rinex {
namespace {

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

/// The next word, taken off the front.
std::string_view take_word(std::string_view& text) {
    text = trimmed(text);
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(word.size());
    return word;
}

int full_year(int year) { return year >= 100 ? year : year + (year >= 80 ? 1900 : 2000); }

struct System {
    char letter;
    std::uint8_t constellation;
    int satellites; ///< highest number
    int ahead;      ///< u-blox's numbers of RINEX's
};
constexpr std::array systems{
    System{'G', constellation::gps, 32, 0},     System{'S', constellation::sbas, 58, 100},
    System{'E', constellation::galileo, 36, 0}, System{'C', constellation::beidou, 63, 0},
    System{'J', constellation::qzss, 10, 0},    System{'R', constellation::glonass, 32, 0},
};

const System* system_of(char letter) {
    const auto* found = std::ranges::find(systems, letter, &System::letter);
    return found == systems.end() ? nullptr : found;
}

} // namespace

std::string_view columns(std::string_view line, std::size_t begin, std::size_t length) {
    return begin < line.size() ? trimmed(line.substr(begin, length)) : std::string_view{};
}

std::optional<int> whole(std::string_view text) {
    text.remove_prefix(text.starts_with('+'));
    int value = 0;
    const auto [end, failed] = std::from_chars(text.begin(), text.end(), value);
    return failed == std::errc{} && end == text.end() ? std::optional{value} : std::nullopt;
}

std::optional<double> real(std::string_view text) {
    std::array<char, 32> buffer{};
    text.remove_prefix(text.starts_with('+'));
    if (text.size() > buffer.size()) return std::nullopt;
    std::ranges::transform(text, buffer.begin(), [](char c) { return c == 'D' || c == 'd' ? 'e' : c; });
    double value = 0;
    const char* const last = buffer.data() + text.size();
    const auto [end, failed] = std::from_chars(buffer.data(), last, value);
    return failed == std::errc{} && end == last && std::isfinite(value) ? std::optional{value} : std::nullopt;
}

std::optional<CivilTime> date(std::string_view text) {
    std::array<int, 5> numbers{};
    for (int& number : numbers) {
        const auto parsed = whole(take_word(text));
        if (!parsed) return std::nullopt;
        number = *parsed;
    }
    const auto second = real(trimmed(text));
    if (!second) return std::nullopt;
    const auto [year, month, day, hour, minute] = numbers;
    return CivilTime{full_year(year), month, day, hour, minute, *second};
}

std::optional<Kind> kind_of(std::string_view first_line) {
    const auto version = real(columns(first_line, 0, 9));
    if (label(first_line) != "RINEX VERSION / TYPE" || !version || first_line.size() <= 40) return std::nullopt;
    return Kind{*version, first_line[20], first_line[40]};
}

std::string_view label(std::string_view line) { return columns(line, 60, 20); }

std::optional<std::uint8_t> constellation_of(char letter) {
    const System* system = system_of(letter);
    return system ? std::optional{system->constellation} : std::nullopt;
}

std::optional<Satellite> satellite(std::string_view text) {
    const System* system = text.empty() ? nullptr : system_of(text[0]);
    const auto number = whole(columns(text, 1, 2));
    if (!system || !number || *number < 1 || *number > system->satellites) return std::nullopt;
    if (system->constellation == constellation::sbas && *number < 20) return std::nullopt;
    return Satellite{system->constellation, static_cast<std::uint8_t>(*number + system->ahead)};
}

} // namespace locus::gnss::rinex
