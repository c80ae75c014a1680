// A cloud of particles that walk on a floor: each has a place and a drive, and a move common to all takes each where
// its own drive turns and stretches it. With an inertial unit the move is a step and the drive is what the unit cannot
// know: by what angle its heading is off the site's, and how much longer this person's steps are. Without one the move
// is a time and the drive is a velocity (paper 004 eq. 4). Structure of arrays, so that every loop is vector
// instructions.
#pragma once

#include "fusion/filter/lanes.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace locus::filter {

struct ParticleSettings {
    int max_count = 1000;
    int min_count = 250;
    double resample_below = 0.5; ///< effective sample size over the count
    double kernel_share = 0.5;   ///< of the optimal bandwidth that resampled particles are spread with; 0: not at all
    double kld_error = 0.05;     ///< Fox 2003: distance between cloud and belief that is not exceeded
    double kld_quantile = 2.326; ///< in 99 of 100 cases
    double bin_m = 0.25;         ///< of the place, where the cloud's spread is counted
    std::uint64_t seed = 1;
};

/// How all particles go on. As complex numbers: place += move * drive.
struct ParticleMove {
    Eigen::Vector2d move{0, 0};
    double place_sigma_m = 0;      ///< of each axis, new for each particle
    double drive_sigma = 0;        ///< of each component of the drive, in its unit
    double drive_length_sigma = 0; ///< relative
    double drive_turn_sigma_rad = 0;
};

/// Likelihood of a residual (measured less expected): a bell, and under it the long tails of a blocked path, which
/// makes ranges longer more often than shorter.
struct ParticleNoise {
    double sigma_m = 0.1;
    double outlier_share = 0.1;
    double long_tail_m = 1; ///< half-width of the tail on the side of too long
    double short_tail_m = 1;
};

class Particles {
  public:
    using Vector4 = Eigen::Vector4d; ///< place x, y, m; drive, real and imaginary
    using Matrix4 = Eigen::Matrix4d;
    using Point = Eigen::Vector2d;

    explicit Particles(const ParticleSettings& settings);

    /// Takes the state of another cloud of the same settings. Does not allocate.
    void copy_from(const Particles& other) noexcept;

    void start(const Vector4& mean, const Matrix4& covariance) noexcept;
    /// At places of a lattice as likely as `weights` say (their sum is one), within half a `cell_m` of each; `place_m`
    /// gives a place by its index. Drives of mean zero.
    template <class PlaceOf>
    void scatter(std::span<const float> weights, const PlaceOf& place_m, double cell_m, double drive_sigma) noexcept;
    void move(const ParticleMove& given) noexcept;

    /// Shuts out the particles whose last move went through a wall: begin, each wall that stands near, end.
    void begin_walls() noexcept;
    void hit_wall(const Point& from_m, const Point& to_m) noexcept;
    void end_walls() noexcept;

    /// Distance to a point whose height above the cloud is `dz_m`.
    void weigh_range(const Point& anchor_m, double dz_m, double range_m, const ParticleNoise& noise) noexcept;
    void weigh_difference(const Point& a_m, double a_dz_m, const Point& b_m, double b_dz_m, double difference_m,
                          const ParticleNoise& noise) noexcept;
    /// By the logarithm of a likelihood at each place: float(float x, float y). Only its differences count, so that
    /// no evidence is too strong to be told in floats.
    template <class LogLikelihood>
    void weigh_places(const LogLikelihood& log_likelihood) noexcept;
    /// Weighted mean of a value at each place: double(float x, float y).
    template <class Value>
    double mean_of(const Value& value) const noexcept;

    /// Drives of mean length 1 and this relative deviation are the likely ones: for drives that were made of
    /// velocities.
    void weigh_drive_length(double sigma) noexcept;

    /// Forgets all drives and draws new ones; `sigma` is of each component.
    void redraw_drives(const Eigen::Vector2d& mean, double sigma) noexcept;
    /// All drives turned and stretched alike, as a complex factor.
    void turn_drives(const Eigen::Vector2d& factor) noexcept;
    /// Widens the cloud about its mean: covariance times `factor` > 0.
    void widen(double factor) noexcept;

    /// Makes the weights' sum one and the moments true. False: nothing was left, and the weights are equal again.
    bool settle() noexcept;
    /// Where the effective sample size is low: systematic resampling (Kitagawa 1996) to the count that the spread needs
    /// (Fox 2003), spread by a kernel that keeps the moments (Musso, Oudjane, LeGland 2001; Liu, West 2001).
    void resample_if_poor() noexcept;

    const Vector4& mean() const noexcept { return mean_; }
    const Matrix4& covariance() const noexcept { return covariance_; }
    double effective_size() const noexcept { return effective_size_; }
    std::size_t size() const noexcept { return count_; }

  private:
    using Array = std::vector<float>; ///< max_count, rounded up to whole lanes; behind count_ all weights are zero
    enum Part { x, y, u, v, part_count };

    std::size_t lanes_end() const noexcept {
        return (count_ + LaneRandom::width - 1) / LaneRandom::width * LaneRandom::width;
    }
    void equal_weights() noexcept;
    void hold_spare_lanes() noexcept;
    void fill_moments() noexcept;
    std::size_t wanted_count() const noexcept;
    std::size_t bins_in_use() const noexcept;
    void choose(std::size_t count) noexcept;
    void spread(std::size_t count) noexcept;

    ParticleSettings settings_;
    LaneRandom random_;
    std::array<Array, part_count> parts_, before_; ///< before_: places before the last move; room for resampling
    Array weights_, passing_;
    std::size_t count_ = 0;
    Vector4 mean_ = Vector4::Zero();
    Matrix4 covariance_ = Matrix4::Identity();
    double effective_size_ = 0;
};

template <class LogLikelihood>
void Particles::weigh_places(const LogLikelihood& log_likelihood) noexcept {
    float most = -std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < count_; ++i) {
        passing_[i] = log_likelihood(parts_[x][i], parts_[y][i]);
        most = std::max(most, passing_[i]);
    }
    for (std::size_t i = 0; i < count_; ++i) weights_[i] *= exp_of_negative(passing_[i] - most);
}

template <class Value>
double Particles::mean_of(const Value& value) const noexcept {
    double sum = 0;
    for (std::size_t i = 0; i < count_; ++i) sum += double{weights_[i]} * value(parts_[x][i], parts_[y][i]);
    return sum;
}

/// A comb over the sum of weights, as in resampling.
template <class PlaceOf>
void Particles::scatter(std::span<const float> weights, const PlaceOf& place_m, double cell_m,
                        double drive_sigma) noexcept {
    count_ = static_cast<std::size_t>(settings_.max_count);
    const double tooth = 1 / static_cast<double>(count_);
    auto reached = double{weights[0]};
    double wanted = tooth * double{random_.uniform()};
    std::size_t from = 0;
    for (std::size_t i = 0; i < count_; ++i) {
        while (reached < wanted && from + 1 < weights.size()) reached += double{weights[++from]};
        const Point place = place_m(from);
        parts_[x][i] = static_cast<float>(place.x() + cell_m * (double{random_.uniform()} - 0.5));
        parts_[y][i] = static_cast<float>(place.y() + cell_m * (double{random_.uniform()} - 0.5));
        wanted += tooth;
    }
    mean_.head<2>() = place_m(from);
    equal_weights();
    redraw_drives({0, 0}, drive_sigma);
    effective_size_ = static_cast<double>(count_);
}

} // namespace locus::filter
