// What one may learn from somebody who may have learnt it from oneself. Two walkers who range each other again and
// again share their errors, and nobody keeps count of how much: a Kalman update would take the same news for new each
// time and grow sure of it. Covariance intersection (Julier, Uhlmann 1997) is right whatever the correlation: own
// knowledge counts for a part, the other's word for the rest of one. For relative measurements between robots:
// Carrillo-Arce, Nerurkar, Gordillo, Roumeliotis 2013, "Decentralized multi-robot cooperative localization using
// covariance intersection".
#pragma once

namespace locus::filter {

/// How a scalar observation with foreign errors in it goes in: the covariance is first divided by `own`, the
/// observation's variance by 1 - own, then it is an ordinary update. own = 1: it promises nothing and is left out.
struct Intersection {
    double own = 1;
    bool worth() const { return own < 1; }
};

/// The part that makes `trace` of the result least: of the covariance after the update, seen through rows `view` (the
/// whole state must be divided, also what the observation does not touch, so what matters has to be said).
/// `state_variance` = h'Ph, `variance` of the observation with the other's own uncertainty, `trace` = tr(V P V'),
/// `gain` = |V P h|^2.
inline Intersection intersect(double trace, double gain, double state_variance, double variance) noexcept {
    constexpr int steps = 64;
    constexpr double least_gain = 0.02; // for less the mean is not worth moving
    Intersection best;
    double least = trace * (1 - least_gain);
    for (int i = 1; i < steps; ++i) {
        const double own = static_cast<double>(i) / steps;
        const double left = (trace - gain / (state_variance + variance * own / (1 - own))) / own;
        if (left >= least) continue;
        least = left;
        best.own = own;
    }
    return best;
}

} // namespace locus::filter
