// RINEX is made of fixed columns: what stands in some of them, as text, number or date.
#pragma once

#include "fusion/gnss/calendar.h"

#include <optional>
#include <string>
#include <string_view>

namespace locus::gnss::rinex {

/// Longest line that is looked at; those of satellites with all signals of RINEX 3 have some 1500 characters.
inline constexpr std::size_t longest_line = 4096;

/// Columns counted from 0, without blanks around; what lies behind the line's end is empty.
std::string_view columns(std::string_view line, std::size_t begin, std::size_t length);

std::optional<int> whole(std::string_view text);
/// Also with the exponent D of FORTRAN, and without a digit before the point. Finite.
std::optional<double> real(std::string_view text);

/// "2019  4 28 12 44 33.9970000": year (two or four digits), month, day, hour, minute, second, apart by blanks.
/// A year of two digits is one of 1980 to 2079.
std::optional<CivilTime> date(std::string_view text);

/// The first line of a file.
struct Kind {
    double version = 0;
    char type = 0;   ///< O observations, N navigation, G GLONASS navigation (version 2)
    char system = 0; ///< of the satellites; M: mixed
};

/// Empty when it is not the first line of a RINEX file.
std::optional<Kind> kind_of(std::string_view first_line);

/// The label at the end of a header line.
std::string_view label(std::string_view line);

/// Numbers of u-blox for a letter of RINEX; empty for others (NavIC).
std::optional<std::uint8_t> constellation_of(char letter);

/// "G05", "R 1": constellation and number as u-blox counts (SBAS from 120 on). Empty when there is no such satellite.
struct Satellite {
    std::uint8_t constellation, number;
};
std::optional<Satellite> satellite(std::string_view text);

} // namespace locus::gnss::rinex
