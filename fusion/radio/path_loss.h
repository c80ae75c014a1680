// Log-distance path loss (Rappaport, Wireless Communications, 2nd ed., eq. 4.69): strength falls by 10 n dB in each
// decade of distance, with a normal deviation in dB for what stands about. Where no map exists it is all that is known.
#pragma once

#include <optional>
#include <span>

namespace locus::radio {

struct PathLoss {
    double power_1m_dbm = -50;
    double exponent = 2; ///< 2 in free space, 1.6 to 3.3 indoors (Rappaport, table 4.2)
    double sigma_db = 5; ///< of the deviation; 3 to 7 dB indoors (same place)

    /// Distances below 0.1 m count as 0.1 m.
    double expected_dbm(double distance_m) const noexcept;
    double distance_m(double rssi_dbm) const noexcept;
};

struct StrengthAtDistance {
    double distance_m = 1;
    double rssi_dbm = 0;
};

/// Least squares over the logarithm of the distance. Empty with fewer than three samples, or all at one distance.
std::optional<PathLoss> fit_path_loss(std::span<const StrengthAtDistance> samples) noexcept;

} // namespace locus::radio
