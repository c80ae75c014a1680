// One 3D position from 8 anchors, noise 0.3 m: ours (two starts, geometry checks, covariance) beside Ceres TinySolver
// with automatic derivatives, which starts from the centroid and checks nothing. Same epochs, same program.
#include "fusion/uwb/solve.h"
#include "tests/unit/fusion/uwb/hall.h"

#include <benchmark/benchmark.h>

#if __has_include(<ceres/tiny_solver.h>)
#include <ceres/tiny_solver.h>
#include <ceres/tiny_solver_autodiff_function.h>
#endif

#include <array>

namespace {

using namespace locus::uwb;
using namespace locus::uwb::test;

constexpr double sigma_m = 0.3;
constexpr std::size_t epoch_count = 256;

std::vector<Vector3d> tags() {
    std::mt19937_64 random(3);
    std::vector<Vector3d> tags;
    for (std::size_t i = 0; i < epoch_count; ++i) tags.push_back(inside(box, random));
    return tags;
}

std::vector<std::vector<DifferenceOf>> noisy_differences(const Pairs& pairs) {
    std::mt19937_64 random(5);
    std::normal_distribution<double> noise(0, sigma_m);
    std::vector<std::vector<DifferenceOf>> epochs;
    for (const Vector3d& tag : tags()) {
        epochs.push_back(differences_from(tag, box, pairs));
        for (DifferenceOf& difference : epochs.back()) {
            difference.difference_m += noise(random);
            difference.sigma_m = sigma_m;
        }
    }
    return epochs;
}

std::vector<std::vector<RangeTo>> noisy_ranges() {
    std::mt19937_64 random(5);
    std::normal_distribution<double> noise(0, sigma_m);
    std::vector<std::vector<RangeTo>> epochs;
    for (const Vector3d& tag : tags()) {
        epochs.push_back(ranges_from(tag, box));
        for (RangeTo& range : epochs.back()) {
            range.range_m += noise(random);
            range.sigma_m = sigma_m;
        }
    }
    return epochs;
}

void differences_from_one_reference(benchmark::State& state) {
    const auto epochs = noisy_differences(against_first(box));
    std::size_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(solve_differences(epochs[i++ % epoch_count], {}));
}
BENCHMARK(differences_from_one_reference);

void differences_round_robin(benchmark::State& state) {
    const auto epochs = noisy_differences(round_robin(box));
    std::size_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(solve_differences(epochs[i++ % epoch_count], {}));
}
BENCHMARK(differences_round_robin);

void ranges(benchmark::State& state) {
    const auto epochs = noisy_ranges();
    std::size_t i = 0;
    for (auto _ : state) benchmark::DoNotOptimize(solve_ranges(epochs[i++ % epoch_count], {}));
}
BENCHMARK(ranges);

#if __has_include(<ceres/tiny_solver.h>)
struct DifferenceResiduals {
    static constexpr int count = 7;
    const std::vector<DifferenceOf>* differences;

    template <class T>
    bool operator()(const T* position, T* residuals) const {
        const auto distance = [&](const locus::Vec3& anchor) {
            T sum(0);
            for (int axis = 0; axis < 3; ++axis)
                sum += (position[axis] - anchor[axis]) * (position[axis] - anchor[axis]);
            return ceres::sqrt(sum);
        };
        const T to_reference = distance((*differences)[0].anchor_a_site_m);
        for (int i = 0; i < count; ++i) {
            const DifferenceOf& d = (*differences)[i];
            residuals[i] = (distance(d.anchor_b_site_m) - to_reference - d.difference_m) / d.sigma_m;
        }
        return true;
    }
};

void differences_ceres_tiny_solver(benchmark::State& state) {
    using Function = ceres::TinySolverAutoDiffFunction<DifferenceResiduals, DifferenceResiduals::count, 3>;
    const auto epochs = noisy_differences(against_first(box));
    Vector3d centroid = Vector3d::Zero();
    for (const Vector3d& anchor : box) centroid += anchor / static_cast<double>(box.size());
    std::size_t i = 0;
    for (auto _ : state) {
        const DifferenceResiduals residuals{&epochs[i++ % epoch_count]};
        const Function function(residuals);
        ceres::TinySolver<Function> solver;
        Vector3d position = centroid;
        benchmark::DoNotOptimize(solver.Solve(function, &position));
        benchmark::DoNotOptimize(position);
    }
}
BENCHMARK(differences_ceres_tiny_solver);
#endif

} // namespace
