// Constants of units.
#pragma once

namespace locus {

inline constexpr double standard_gravity_mps2 = 9.80665; ///< BIPM, The International System of Units
inline constexpr double rad_per_deg = 0.017453292519943295;

} // namespace locus
