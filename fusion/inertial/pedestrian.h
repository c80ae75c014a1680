// Pedestrian dead reckoning (paper 004, section 2.1): an inertial unit worn at the waist, in a pocket or in a hand goes
// in, steps come out, each with its length and the heading it was made in. Headings count from where the device pointed
// when it was first heard, so a constant is left open: what turns them into the site's is for the filter behind.
#pragma once

#include "fusion/inertial/attitude.h"
#include "fusion/inertial/compass.h"
#include "fusion/inertial/stance.h"
#include "fusion/inertial/step_detector.h"
#include "fusion/inertial/step_length.h"
#include "fusion/measurement.h"

#include <optional>

namespace locus::inertial {

struct Step {
    Timestamp time;            ///< when the step's wave had its peak
    double duration_s = 0;     ///< since the step before
    double length_m = 0;       ///< of a mean person's step that bounces as this one did
    double length_sigma_m = 0; ///< of this step against the person's others
    double heading_rad = 0;    ///< mean over the step; from the first heading, counter-clockwise from above
    double heading_sigma_rad = 0;
};

struct PedestrianSettings {
    AttitudeSettings attitude;
    CompassSettings compass;
    StepDetectorSettings steps;
    StepLengthSettings length;
    StanceSettings standing = waist_stance;
    double levelling_s = 0.5; ///< of specific force that the first attitude is made from
    bool use_compass = true;  ///< where the unit has a magnetometer
};

class Pedestrian {
  public:
    explicit Pedestrian(const PedestrianSettings& settings)
        : settings_(settings), attitude_(settings.attitude), compass_(settings.compass), steps_(settings.steps),
          standing_still_(settings.standing) {}

    /// Takes a sample with finite numbers; one that is not later than the last is left out.
    std::optional<Step> hear(const ImuSample& sample, Timestamp time) noexcept;

    /// Whether the attitude is there.
    bool ready() const noexcept { return ready_; }
    bool standing() const noexcept { return standing_; }
    double heading_rad() const noexcept { return attitude_.heading_rad(); }
    double heading_variance_rad2() const noexcept { return attitude_.heading_variance_rad2(); }
    const Attitude& attitude() const noexcept { return attitude_; }

  private:
    void level_first(const Eigen::Vector3d& force, double dt_s) noexcept;
    void follow(const ImuSample& sample, double dt_s) noexcept;
    Step make(const Stride& stride) noexcept;

    PedestrianSettings settings_;
    Attitude attitude_;
    Compass compass_;
    StepDetector steps_;
    StanceDetector standing_still_;
    std::optional<Timestamp> last_time_;
    Eigen::Vector3d force_sum_ = Eigen::Vector3d::Zero(); ///< until the attitude is there, m/s
    double levelled_s_ = 0;
    Eigen::Vector2d facing_sum_ = Eigen::Vector2d::Zero(); ///< unit vectors of the heading since the last step
    bool ready_ = false;
    bool standing_ = false;
};

} // namespace locus::inertial
