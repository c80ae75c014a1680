// The value of pi with which all constellations compute semicircles (IS-GPS-200, section 20.3.3.4.3.1).
#pragma once

namespace locus::gnss {
inline constexpr double interface_pi = 3.1415926535898; // NOLINT(modernize-use-std-numbers): with these digits
}
