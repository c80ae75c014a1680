// A person with an inertial unit at the waist, drawn from a seed: the body bobs once a step, sways, leans and turns;
// the unit has a bias, noise and a tilt in which it is worn. Beside each sample the truth.
#pragma once

#include "fusion/geometry/rotation.h"
#include "fusion/measurement.h"
#include "fusion/units.h"

#include <Eigen/Dense>

#include <cmath>
#include <numbers>
#include <random>

namespace locus::test {

struct WalkerModel {
    double rate_hz = 100;
    double speed_mps = 1.3;
    double steps_hz = 1.8;
    double bob_mps2 = 2.5;         ///< amplitude of the vertical acceleration
    double gyro_bias_radps = 0.01; ///< sigma of each axis; BMI160 after its own calibration
    double gyro_noise_radps_rthz = 2.6e-4;
    double force_noise_mps2_rthz = 2e-3; ///< 200 ug per root Hz
    double force_bias_mps2 = 0.1;
    Eigen::Quaterniond worn = rotation(Eigen::Vector3d(1.2, 0.4, -0.7)); ///< body to upright
};

class SimulatedWalker {
  public:
    SimulatedWalker(const WalkerModel& model, unsigned seed) : model_(model), random_(seed) {
        for (int axis = 0; axis < 3; ++axis) gyro_bias_(axis) = model.gyro_bias_radps * draw();
        for (int axis = 0; axis < 3; ++axis) force_bias_(axis) = model.force_bias_mps2 * draw();
    }

    /// Moves on by one sample; `walking` false: stands.
    ImuSample move(double turn_radps, bool walking = true) {
        const double dt_s = 1 / model_.rate_hz;
        time_s_ += dt_s;
        heading_rad_ += turn_radps * dt_s;
        const double speed_mps = walking ? model_.speed_mps : 0;
        position_m_ += speed_mps * dt_s * Eigen::Vector2d(std::cos(heading_rad_), std::sin(heading_rad_));
        if (walking) steps_ += model_.steps_hz * dt_s;
        const double phase = 2 * std::numbers::pi * steps_;
        const double bob = walking ? model_.bob_mps2 : 0;
        const Eigen::Vector3d along(0.4 * bob * std::sin(phase), 0.3 * bob * std::sin(phase / 2),
                                    bob * std::cos(phase));
        const Eigen::Vector3d lean(0, 0, 0.08 * (walking ? std::sin(phase / 2) : 0)); // the hips turn with the legs
        const Eigen::Vector3d rate(
            0, 0, turn_radps + (walking ? 0.08 * std::numbers::pi * model_.steps_hz * std::cos(phase / 2) : 0));
        const Eigen::Quaterniond level_to_body =
            (rotation(Eigen::Vector3d(0, 0, heading_rad_) + lean) * model_.worn).conjugate();
        const Eigen::Vector3d up(0, 0, standard_gravity_mps2);
        const Eigen::Vector3d level = rotation(Eigen::Vector3d(0, 0, heading_rad_)) * along + up;
        ImuSample sample;
        sample.tag = address(9);
        write(level_to_body * level + force_bias_, model_.force_noise_mps2_rthz, sample.specific_force_mps2);
        write(level_to_body * rate + gyro_bias_, model_.gyro_noise_radps_rthz, sample.angular_rate_radps);
        return sample;
    }

    /// The Earth's field in the middle latitudes, 50 microtesla, 65 deg steep, plus what is said.
    Vec3f field(const Eigen::Vector3d& disturbance_ut) const {
        const Eigen::Vector3d level = Eigen::Vector3d(5, 20, -45) + disturbance_ut;
        const Eigen::Vector3d body = (rotation(Eigen::Vector3d(0, 0, heading_rad_)) * model_.worn).conjugate() * level;
        return {static_cast<float>(body.x()), static_cast<float>(body.y()), static_cast<float>(body.z())};
    }

    double time_s() const { return time_s_; }
    Timestamp time() const { return timestamp_from_s(time_s_); }
    double heading_rad() const { return heading_rad_; }
    double steps() const { return steps_; }
    const Eigen::Vector2d& position_m() const { return position_m_; }
    void place(const Eigen::Vector2d& position_m, double heading_rad) {
        position_m_ = position_m;
        heading_rad_ = heading_rad;
    }

  private:
    double draw() { return normal_(random_); }
    void write(const Eigen::Vector3d& value, double noise_rthz, Vec3& to) {
        for (int axis = 0; axis < 3; ++axis) to[axis] = value(axis) + noise_rthz * std::sqrt(model_.rate_hz) * draw();
    }

    WalkerModel model_;
    std::mt19937 random_;
    std::normal_distribution<double> normal_;
    Eigen::Vector3d gyro_bias_, force_bias_;
    Eigen::Vector2d position_m_{0, 0};
    double heading_rad_ = 0;
    double steps_ = 0;
    double time_s_ = 1;
};

} // namespace locus::test
