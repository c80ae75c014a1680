// One prediction over 20 ms and four ranges taken in, nine states: ours (TrackState and scalar updates) and a plain
// filter of full matrices with Eigen, as textbooks write it. Beside it ours with the errors of eight anchors and the
// common one as states, which is what range_ekf carries by default.
#include "fusion/filter/scalar_update.h"
#include "fusion/filter/track_state.h"
#include "fusion/uwb/range_model.h"

#include <Eigen/Dense>
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>

namespace {

using namespace locus;
using filter::TrackState;

constexpr double step_s = 0.02;
constexpr double range_variance_m2 = 0.01;
const std::array<Eigen::Vector3d, 4> anchors{{{0, 0, 0.2}, {10, 0, 2.8}, {10, 8, 0.2}, {0, 8, 2.8}}};
const filter::TrackModel model{{3, 0.1}, 1, false};

/// A tag on a circle; the noise is a pattern, so that the filters do the same work for ever.
class Ranges {
  public:
    const std::array<double, 4>& next() {
        const auto i = count_++ % rounds_.size();
        return rounds_[i];
    }
    Ranges() {
        for (std::size_t round = 0; round < rounds_.size(); ++round) {
            const double turn = 2 * 3.14159265358979 * static_cast<double>(round) / static_cast<double>(rounds_.size());
            const Eigen::Vector3d tag(5 + 2 * std::cos(turn), 4 + 2 * std::sin(turn), 1.2);
            for (std::size_t a = 0; a < anchors.size(); ++a)
                rounds_[round][a] =
                    uwb::range(tag, anchors[a]) + 0.1 * std::sin(37.0 * static_cast<double>(4 * round + a));
        }
    }

  private:
    std::array<std::array<double, 4>, 512> rounds_{};
    std::size_t count_ = 0;
};

/// What a filter says at the end, so that none is fast by being elsewhere.
void check(benchmark::State& state, const Eigen::Vector3d& position_m) {
    const double radius_m = (position_m - Eigen::Vector3d(5, 4, 1.2)).head<2>().norm();
    if (!(std::abs(radius_m - 2) < 0.5)) state.SkipWithError("the filter is not where the tag is");
}

TrackState started() {
    TrackState track(model);
    track.start({7, 4, 1.2}, 0.01 * Eigen::Matrix3d::Identity());
    return track;
}

template <class Vector, class Matrix>
void take(const std::array<double, 4>& ranges_m, Vector& x, Matrix& covariance) {
    for (std::size_t a = 0; a < anchors.size(); ++a) {
        const uwb::Sight sight = uwb::sight_of({x(0), x(3), x(6)}, anchors[a]);
        Vector jacobian = Vector::Zero(x.size());
        for (int axis = 0; axis < 3; ++axis) jacobian(TrackState::place(axis, 0)) = sight.gradient(axis);
        filter::update_scalar(x, covariance, filter::predict_scalar(covariance, jacobian), ranges_m[a] - sight.range_m,
                              range_variance_m2);
    }
}

void ours(benchmark::State& state) {
    TrackState track = started();
    for (int i = 0; i < state.range(0); ++i) track.wanderer(i, {0.2, 0.3});
    Ranges ranges;
    for (auto _ : state) {
        track.predict(step_s);
        take(ranges.next(), track.state, track.covariance);
    }
    check(state, track.position_m());
}
BENCHMARK(ours)->ArgName("wanderers")->Arg(0)->Arg(9);

Eigen::Matrix<double, 9, 9> whole(const Eigen::Matrix3d& block) {
    Eigen::Matrix<double, 9, 9> all = Eigen::Matrix<double, 9, 9>::Zero();
    for (int axis = 0; axis < 3; ++axis) all.block<3, 3>(3 * axis, 3 * axis) = block;
    return all;
}

void full_matrices(benchmark::State& state) {
    using Matrix = Eigen::Matrix<double, 9, 9>;
    TrackState start = started();
    Eigen::Matrix<double, 9, 1> x = start.state;
    Matrix covariance = start.covariance;
    Ranges ranges;
    for (auto _ : state) {
        const filter::AxisStep step = filter::axis_step(model.motion, step_s);
        const Matrix transition = whole(step.transition);
        x = transition * x;
        covariance = transition * covariance * transition.transpose() + whole(step.noise);
        Eigen::Matrix<double, 4, 9> jacobian = Eigen::Matrix<double, 4, 9>::Zero();
        Eigen::Vector4d innovation;
        const auto& ranges_m = ranges.next();
        for (int a = 0; a < 4; ++a) {
            const uwb::Sight sight = uwb::sight_of({x(0), x(3), x(6)}, anchors[static_cast<std::size_t>(a)]);
            for (int axis = 0; axis < 3; ++axis) jacobian(a, 3 * axis) = sight.gradient(axis);
            innovation(a) = ranges_m[static_cast<std::size_t>(a)] - sight.range_m;
        }
        const Eigen::Matrix<double, 9, 4> cross = covariance * jacobian.transpose();
        const Eigen::Matrix4d spread = jacobian * cross + range_variance_m2 * Eigen::Matrix4d::Identity();
        const Eigen::Matrix<double, 9, 4> gain = cross * spread.inverse();
        x += gain * innovation;
        covariance -= gain * cross.transpose();
        covariance = (0.5 * (covariance + covariance.transpose())).eval();
    }
    check(state, {x(0), x(3), x(6)});
}
BENCHMARK(full_matrices);

} // namespace
