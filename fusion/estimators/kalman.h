// Kalman filters behind Chan-Taylor, as paper 000 has them: the plain one, the augmented one that knows the noise to be
// coloured, and the paper's own with principal components before it. They are here to be compared with; range_ekf takes
// the measurements themselves, each at its own time, and any number of them.
// Velocity's random walk 1.3 m/s in a second: what range_ekf's acceleration of 3 m/s^2 for 0.1 s comes to.
#pragma once

#include "fusion/estimators/epoch_estimator.h"
#include "fusion/filter/fix_filter.h"
#include "fusion/filter/pca_window.h"

namespace locus {

struct KalmanSettings : EpochEstimatorSettings {
    double velocity_walk = 1.3;
};

template <class Settings>
inline constexpr std::array velocity_options{option<&Settings::velocity_walk, Settings>(
    "velocity_walk", "m/s/sqrt(s)", 0.001, 1000,
    "Change of velocity that the target is capable of: its standard deviation after a second.")};

inline constexpr auto all_kalman_options =
    joined(epoch_estimator_options<KalmanSettings>, velocity_options<KalmanSettings>);

struct ColouredKalmanSettings : KalmanSettings {
    double anchor_error_time_s = 0.3;
};

inline constexpr std::array held_error_options{option<&ColouredKalmanSettings::anchor_error_time_s>(
    "anchor_error_time_s", "s", 0.01, 1e6, "Time in which an anchor's error becomes another one.")};

inline constexpr auto all_coloured_options =
    joined(joined(epoch_estimator_options<ColouredKalmanSettings>, velocity_options<ColouredKalmanSettings>),
           held_error_options);

struct PcaKalmanSettings : KalmanSettings {
    int window = filter::PcaModel{}.window;
    double straight = filter::PcaModel{}.straight;
};

template <class Settings>
inline constexpr std::array pca_options{
    option<&PcaKalmanSettings::window, Settings>("window", "", 5, filter::PcaWindow::most,
                                                 "Positions, at most, that the principal axis is made from."),
    option<&PcaKalmanSettings::straight, Settings>(
        "straight", "", 0.1, 1000,
        "Variance across the principal axis, over that of the positions, up to which they are one straight piece."),
};

inline constexpr auto all_pca_options =
    joined(joined(epoch_estimator_options<PcaKalmanSettings>, velocity_options<PcaKalmanSettings>),
           pca_options<PcaKalmanSettings>);

filter::FixFilterModel fix_filter_model(const KalmanSettings& settings) noexcept;
/// Each fix's variance in the shares that an anchor's noise and held error have of a range's.
filter::FixFilterModel fix_filter_model(const ColouredKalmanSettings& settings) noexcept;

/// The plain filter or the augmented one, by the settings.
template <class SettingsOf>
class FixKalman {
  public:
    using Settings = SettingsOf;
    static constexpr auto reach = EpochGatherer::Reach::epoch;

    explicit FixKalman(const Settings& settings) noexcept : filter_(fix_filter_model(settings)) {}
    void take(const Eigen::Vector3d& position_m, const Eigen::Matrix3d& covariance_m2, Timestamp time) noexcept {
        filter_.take(position_m, covariance_m2, time);
    }
    void write(Timestamp time, Estimate& estimate) const noexcept { filter_.write(time, estimate); }

  private:
    filter::FixFilter filter_;
};

class PcaKalman {
  public:
    using Settings = PcaKalmanSettings;
    static constexpr auto reach = EpochGatherer::Reach::epoch;

    explicit PcaKalman(const Settings& settings) noexcept : PcaKalman(settings, fix_filter_model(settings)) {}
    /// Paper 000 eq. 18-21: the denoised position, its covariance times the degradation factor.
    void take(const Eigen::Vector3d& position_m, const Eigen::Matrix3d& covariance_m2, Timestamp time) noexcept;
    void write(Timestamp time, Estimate& estimate) const noexcept { filter_.write(time, estimate); }

  protected:
    PcaKalman(const PcaKalmanSettings& settings, const filter::FixFilterModel& model) noexcept
        : window_({settings.window, settings.straight}), filter_(model) {}

  private:
    filter::PcaWindow window_;
    filter::FixFilter filter_;
};

/// The paper's filter with the augmented one behind it: the local UWB filter of `federated`.
struct CarriedPcaSettings : PcaKalmanSettings {
    double anchor_error_time_s = ColouredKalmanSettings{}.anchor_error_time_s;
};

class CarriedPca : public PcaKalman {
  public:
    using Settings = CarriedPcaSettings;
    explicit CarriedPca(const Settings& settings) noexcept;
};

inline constexpr EstimatorRow kalman_row{
    "kalman", "Constant-velocity Kalman filter on the positions of epochs: to compare with.",
    option_table<KalmanSettings>(all_kalman_options), make_epoch_estimator<FixKalman<KalmanSettings>>};

inline constexpr EstimatorRow coloured_kalman_row{
    "coloured_kalman", "The same, its state augmented by the error that positions carry along: to compare with.",
    option_table<ColouredKalmanSettings>(all_coloured_options),
    make_epoch_estimator<FixKalman<ColouredKalmanSettings>>};

inline constexpr EstimatorRow pca_kalman_row{
    "pca_kalman", "The plain filter behind a principal-component denoising of the path: for straight walks.",
    option_table<PcaKalmanSettings>(all_pca_options), make_epoch_estimator<PcaKalman>};

} // namespace locus
