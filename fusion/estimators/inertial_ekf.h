// The default estimator: two navigation filters on the same measurements, one that uses the inertial sensor and one
// that knows nothing of it (two of that kind while there is no sensor, nav_pair.h). A sensor may be mounted loosely,
// clip, or be shaken until its mean is metres per second squared off; nobody can tell from its samples. So the plain
// filter always runs beside the aided one, which has to earn its place: it is published while its heading is found and
// its predictions are no worse than the plain one's.
#pragma once

#include "fusion/estimators/nav_pair.h"

namespace locus {

class InertialEkf final : public Estimator {
  public:
    /// `site` outlives the estimator.
    InertialEkf(const Site& site, const InertialEkfSettings& settings);

    Verdict update(const Measurement& measurement) noexcept override;
    /// A SLAM's path as somebody has aligned it with the site; `odometry` is the measurement that it was.
    Verdict see(const AlignedPlace& place, const Measurement& odometry) noexcept;
    Estimate predict(Timestamp time) const noexcept override;
    std::unique_ptr<Estimator> clone() const override { return std::make_unique<InertialEkf>(*this); }
    void copy_from(const Estimator& other) noexcept override { *this = static_cast<const InertialEkf&>(other); }

    /// For tests.
    const NavTrack& track() const noexcept { return aided_.track(); }

  private:
    void weigh_up(const Verdict& plain, const Verdict& aided, Timestamp time) noexcept;
    Verdict sense(const Measurement& measurement) noexcept;
    void compare(const Verdict& plain, const Verdict& aided, double dt_s) noexcept;
    void turn_to_the_better(Timestamp time) noexcept;
    bool aided_is_worse() const noexcept;
    void start_aided_again() noexcept;
    void count_resets() noexcept;
    bool is_out_of_date(Timestamp time) const noexcept;

    InertialEkfSettings settings_;
    NavPair plain_;
    NavFilter aided_;
    double misfit_plain_ = 0; ///< mean square of the last innovations, each clipped
    double misfit_aided_ = 0; ///< of the same measurements
    double aided_share_ = 0;  ///< 0..1, of the aided filter in what is published
    double probation_s_;      ///< how long it must do well first
    double done_well_s_ = 0;
    bool sensed_ = false;                        ///< there is an inertial sensor
    std::uint32_t resets_ = 0, resets_seen_ = 0; ///< of what was published; of the filter that it came from
    Timestamp compared_{};
    Timestamp time_{};
};

std::unique_ptr<Estimator> make_inertial_ekf(const Site& site, const void* settings);

inline constexpr auto inertial_ekf_options = inertial_options<InertialEkfSettings>;

inline constexpr EstimatorRow inertial_ekf_row{
    "inertial_ekf",
    "The default: everything that comes, with an inertial sensor's attitude and biases where there is one.",
    option_table<InertialEkfSettings>(inertial_ekf_options), make_inertial_ekf};

} // namespace locus
