// The printed numbers of one navigation record, in the file's order, as an ephemeris in the terms of the broadcast.
#pragma once

#include "drivers/gnss/rinex_navigation.h"

#include <optional>
#include <span>
#include <string>

namespace locus::gnss::rinex {

/// The clock's three, then four a line; what is blank is empty.
using Values = std::span<const std::optional<double>>;

/// Empty when the satellite sends what is not read here; `error` says so where a number is missing or is none that can
/// be broadcast. `reference`: date in the record's first line, in the constellation's own time.
std::optional<NavigationRecord> record_of(const Satellite& satellite, const CivilTime& reference, Values values,
                                          std::string& error);

} // namespace locus::gnss::rinex
