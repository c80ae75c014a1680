#include "fusion/radio/path_loss.h"

#include <algorithm>
#include <cmath>

namespace locus::radio {
namespace {

constexpr double nearest_m = 0.1;

/// What the exponent is multiplied with.
double decades_db(double distance_m) { return -10 * std::log10(std::max(distance_m, nearest_m)); }

struct Means {
    double decades = 0, rssi = 0;
};

Means means_of(std::span<const StrengthAtDistance> samples) {
    Means sum;
    for (const auto& sample : samples) {
        sum.decades += decades_db(sample.distance_m);
        sum.rssi += sample.rssi_dbm;
    }
    const auto count = static_cast<double>(samples.size());
    return {sum.decades / count, sum.rssi / count};
}

} // namespace

double PathLoss::expected_dbm(double distance_m) const noexcept {
    return power_1m_dbm + exponent * decades_db(distance_m);
}

double PathLoss::distance_m(double rssi_dbm) const noexcept {
    return std::max(nearest_m, std::pow(10, (power_1m_dbm - rssi_dbm) / (10 * exponent)));
}

std::optional<PathLoss> fit_path_loss(std::span<const StrengthAtDistance> samples) noexcept {
    constexpr double least_variance = 1e-6;
    if (samples.size() < 3) return std::nullopt;
    const Means mean = means_of(samples);
    double spread = 0, common = 0, power = 0;
    for (const auto& sample : samples) {
        const double decades = decades_db(sample.distance_m) - mean.decades, rssi = sample.rssi_dbm - mean.rssi;
        spread += decades * decades;
        common += decades * rssi;
        power += rssi * rssi;
    }
    if (spread < least_variance) return std::nullopt;
    PathLoss fit;
    fit.exponent = common / spread;
    fit.power_1m_dbm = mean.rssi - fit.exponent * mean.decades;
    const double left = std::max(0.0, power - fit.exponent * common);
    fit.sigma_db = std::sqrt(left / static_cast<double>(samples.size() - 2));
    return fit;
}

} // namespace locus::radio
