// Whether a body is at rest: a foot in mid-stance, or a waist whose owner stands. Generalised likelihood ratio of "the
// specific force is gravity, in whatever direction, and nothing turns" over a short window (Skog, Handel, Nilsson,
// Rantakokko 2010, "Zero-velocity detection - an algorithm evaluation", eq. 15: SHOE).
#pragma once

#include <Eigen/Core>
#include <boost/container/static_vector.hpp>

#include <cstddef>

namespace locus::inertial {

/// The sigmas are of what a body at rest still does, not of the sensor: a foot in mid-stance rolls, a waist sways.
struct StanceSettings {
    double force_sigma_mps2 = 0.8;
    double rate_sigma_radps = 0.4;
    double threshold = 1; ///< of the sum of both mean squares, each over its sigma
    double window_s = 0.04;
};

inline constexpr StanceSettings foot_stance{};
/// Standing people sway by some hundredths of m/s^2 and rad/s (Prieto et al. 1996); walking ones move ten times as
/// much.
inline constexpr StanceSettings waist_stance{0.3, 0.1, 1, 0.5};

class StanceDetector {
  public:
    explicit StanceDetector(const StanceSettings& settings) : settings_(settings) {}

    /// Takes a sample `dt_s` after the last; true: the window that ends here is at rest.
    bool hear(const Eigen::Vector3d& specific_force_mps2, const Eigen::Vector3d& angular_rate_radps,
              double dt_s) noexcept;

  private:
    /// Beyond these many samples in a window the oldest go first.
    static constexpr std::size_t max_samples = 96;
    struct Sample {
        Eigen::Vector3d force, rate;
        double dt_s;
    };
    void forget() noexcept;
    double likelihood_ratio() const noexcept;

    StanceSettings settings_;
    boost::container::static_vector<Sample, max_samples> window_;
    double span_s_ = 0;
    double statistic_ = 0;
};

} // namespace locus::inertial
