// Figures as people read them.
#pragma once

#include <optional>
#include <string>

namespace locus::tools {

/// With so many decimals; "-" when unknown.
std::string figure(std::optional<double> value, int decimals);

/// 0.012 -> "12 ms", 3.21 -> "3.2 s", 200 -> "3 min 20 s", 11520 -> "3 h 12 min"; "-" when unknown.
std::string duration(std::optional<double> seconds);

} // namespace locus::tools
