// How a target moves, with an inertial sensor or without. Three ways, each with the same first six numbers, so that the
// track goes from one to the next without a jump:
// - kinematic: no sensor; an acceleration that dies away (filter/motion.h).
// - aligning: the sensor tells what is up but not where it is turned. The acceleration in its level frame is known, and
//   the site's follows from it by (cos, sin) of the unknown heading, which enter linearly: no heading has to be
//   guessed, no number of hypotheses to be carried (Scherzinger 1996, "Inertial navigator error models for large
//   heading uncertainty").
// - inertial: strapdown mechanisation with an error-state filter of fifteen states.
#pragma once

#include "fusion/filter/kinematic_state.h"
#include "fusion/filter/scalar_update.h"
#include "fusion/inertial/held_imu.h"
#include "fusion/inertial/levelling.h"
#include "fusion/inertial/rest.h"
#include "fusion/inertial/stance.h"
#include "fusion/inertial/strapdown.h"

#include <optional>

namespace locus {

struct NavModel {
    filter::TrackModel kinematic;
    inertial::ImuNoise imu;
    double acceleration_bias_sigma_mps2 = 0;
    double angular_rate_bias_sigma_radps = 0;
    double aligning_noise_mps2_rthz = 0;
    bool foot_mounted = false;               ///< the sensor stands still in every step, not only when its wearer does
    Eigen::Vector3d antenna_body_m{0, 0, 0}; ///< from the inertial sensor to the tag's antenna
};

class NavTrack : public filter::KinematicState<inertial::navigation_size> {
  public:
    explicit NavTrack(NavModel model) noexcept;

    /// At rest at `antenna_site_m` with covariance in m^2, not yet inertial; all wanderers are forgotten.
    void start(const Eigen::Vector3d& antenna_site_m, const Eigen::Matrix3d& covariance_m2) noexcept;

    /// `dt_s` >= 0.
    void predict(double dt_s) noexcept;

    /// The state is at `time`. Before start() it only levels.
    void sense(const ImuSample& sample, Timestamp time, bool started) noexcept;

    Eigen::Vector3d antenna_site_m() const noexcept;
    /// From the gradient of an observation by the antenna's position to its gradient by the state, which was zero.
    void spread_gradient(const Eigen::Vector3d& gradient, Vector& jacobian) const noexcept;
    void correct(const filter::Prediction<Vector>& prediction, double innovation, double variance,
                 const filter::Share& share) noexcept;
    void report(Estimate& estimate) const noexcept;

    /// What the other knows of the inertial sensor, but no more: the track goes on without it until it is aligned
    /// again.
    void keep_sensor(const NavTrack& other) noexcept;

    bool is_inertial() const noexcept { return mode_ == Mode::inertial; }
    bool is_at_rest() const noexcept { return model_.foot_mounted ? stands_ : rest_.is_at_rest(); }

  private:
    enum class Mode : std::uint8_t { kinematic, aligning, inertial };
    struct Heading {
        double angle_rad = 0;
        Eigen::Vector2d by_third{0, 0}; ///< its derivative by (cos, sin)
    };

    Eigen::Vector3d lever_site_m() const noexcept;
    inertial::Rates unbiased() const noexcept;
    inertial::Motion motion() const noexcept;
    void set_motion(const inertial::Motion& motion) noexcept;

    void predict_aligning(double dt_s) noexcept;
    void predict_inertial(double dt_s) noexcept;
    template <class Transition>
    void move_core(const Transition& transition, const Transition& noise, double dt_s) noexcept;

    void level(double dt_s) noexcept;
    void step(double dt_s) noexcept;
    void begin_aligning() noexcept;
    std::optional<Heading> heading() const noexcept;
    void begin_inertial(const Heading& heading) noexcept;
    void doubt_sensor() noexcept;
    void fall_back() noexcept;
    void change_mode(Mode mode, const CoreMap& map) noexcept;

    NavModel model_;
    Mode mode_ = Mode::kinematic;
    inertial::HeldImu imu_;
    inertial::Levelling levelling_;
    inertial::Rest rest_;
    inertial::StanceDetector stance_{inertial::foot_stance};
    bool stands_ = false; ///< the foot, as of the last sample
    double since_imu_s_ = 0;
    Eigen::Quaterniond body_to_site_ = Eigen::Quaterniond::Identity(); ///< in inertial mode
};

} // namespace locus
