// A cloud of particles that goes as people go: by the steps of a worn inertial unit where one is heard, by a wandering
// velocity where there is none (paper 004 eq. 4), and not through walls. What weighs it is the estimators' own.
#pragma once

#include "fusion/estimators/gait.h"
#include "fusion/filter/particles.h"
#include "fusion/pose.h"
#include "fusion/site.h"

#include <limits>
#include <utility>

namespace locus {

struct WalkingSettings {
    filter::ParticleSettings particles;
    GaitSettings gait;
    double velocity_wander_mps_rts = 1;
    /// In which a velocity is forgotten without an inertial unit; infinite: it only wanders.
    double velocity_time_s = std::numeric_limits<double>::infinity();
    double person_sigma = 0.15;
    double height_m = 1.2;
    double height_sigma_m = 0.2;
};

class WalkingCloud {
  public:
    /// `site` outlives it. Places inside are relative to `origin_site_m`, so that single precision is enough.
    WalkingCloud(const Site& site, Eigen::Vector2d origin_site_m, const WalkingSettings& settings)
        : site_(&site), settings_(settings), origin_(std::move(origin_site_m)), cloud_(settings.particles),
          gait_(settings.gait) {}

    /// Takes the state of another one of the same site and settings. Does not allocate.
    void copy_from(const WalkingCloud& other) noexcept;

    void hear(const ImuSample& sample, Timestamp time) noexcept { gait_.hear(sample, time); }

    /// Whether steps lead it and have, so that what is known of the heading is worth keeping.
    bool by_steps() const noexcept { return by_steps_; }
    /// Where its particles were put by the caller: from now on it moves from here.
    void begin(Timestamp time) noexcept;
    /// The same, of particles whose drives are velocities: steps must lead it anew.
    void begin_anew(Timestamp time) noexcept {
        by_steps_ = false;
        begin(time);
    }
    /// Carries it on to `time`, with walls, and makes its moments true.
    void advance(Timestamp time) noexcept;
    /// After weighing. False: nothing was left, and the weights are equal again.
    bool settle() noexcept;

    /// Place, velocity and their covariance at `time`, at or after time().
    void write(Timestamp time, Estimate& estimate) const noexcept;

    filter::Particles& particles() noexcept { return cloud_; }
    const filter::Particles& particles() const noexcept { return cloud_; }
    Timestamp time() const noexcept { return time_; }
    /// Velocity over drive.
    Eigen::Vector2d pace() const noexcept;
    Eigen::Vector2d local(const Vec3& site_m) const noexcept {
        return {site_m[0] - origin_.x(), site_m[1] - origin_.y()};
    }
    const Eigen::Vector2d& origin_site_m() const noexcept { return origin_; }
    Eigen::Vector3d place_site_m() const noexcept;

  private:
    void stop_at_walls(double move_m) noexcept;
    void lead_by_steps() noexcept;
    void lead_by_velocity() noexcept;
    void forget_velocity(double dt_s) noexcept;
    filter::ParticleMove wander(double dt_s) const noexcept;

    const Site* site_;
    WalkingSettings settings_;
    Eigen::Vector2d origin_;
    filter::Particles cloud_;
    Gait gait_;
    bool by_steps_ = false; ///< drives are turn and stretch of steps; else velocities
    Timestamp time_{};      ///< of the cloud
};

} // namespace locus
