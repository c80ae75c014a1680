#include "fusion/inertial/held_imu.h"

#include "fusion/geometry/vector.h"

namespace locus::inertial {

std::optional<HeldImu::Lag> HeldImu::take(const ImuSample& sample, Timestamp time) noexcept {
    const Rates fresh{vector(sample.specific_force_mps2), vector(sample.angular_rate_radps)};
    std::optional<Lag> lag;
    if (taken_ && is_fresh(time))
        lag = Lag{{fresh.specific_force_mps2 - rates_.specific_force_mps2,
                   fresh.angular_rate_radps - rates_.angular_rate_radps},
                  to_s(time - *taken_)};
    rates_ = fresh;
    taken_ = time;
    return lag;
}

} // namespace locus::inertial
