#include "tools/replay/smooth.h"

#include "daemon/socket/pose_line.h"
#include "fusion/geometry/error_bound.h"
#include "tools/replay/mirror.h"
#include "tools/replay/ticker.h"

#include <Eigen/Dense>

#include <algorithm>
#include <map>
#include <utility>

namespace locus::replay {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6, Eigen::RowMajor>;

Vector6 state(const Estimate& estimate) {
    Vector6 state;
    for (int i = 0; i < 3; ++i) {
        state(i) = estimate.position_site_m[static_cast<std::size_t>(i)];
        state(i + 3) = estimate.velocity_site_mps[static_cast<std::size_t>(i)];
    }
    return state;
}

Matrix6 covariance(const Estimate& estimate) { return Matrix6(estimate.covariance.data()); }

/// A height that is known has no variance; then nothing is to be weighed either.
Matrix6 share_of_after(const Matrix6& before, const Matrix6& after) {
    const Matrix6 sum = before + after;
    return before * sum.completeOrthogonalDecomposition().pseudoInverse();
}

bool has_orientation(const Estimate& estimate) {
    return std::ranges::any_of(estimate.orientation_xyzw, [](double number) { return number != 0; });
}

const Estimate& surer(const Estimate& a, const Estimate& b) {
    const auto spread = [](const Estimate& e) { return e.covariance[0] + e.covariance[7] + e.covariance[14]; };
    return spread(a) <= spread(b) ? a : b;
}

} // namespace

Estimate combined(const Estimate& before, const Estimate& after) {
    const Matrix6 share = share_of_after(covariance(before), covariance(after));
    const Vector6 mean = state(before) + share * (state(after) - state(before));
    Estimate result = before;
    for (std::size_t i = 0; i < 3; ++i) {
        result.position_site_m[i] = mean(static_cast<int>(i));
        result.velocity_site_mps[i] = mean(static_cast<int>(i) + 3);
    }
    result.covariance = surer(before, after).covariance;
    if (!has_orientation(before)) result.orientation_xyzw = after.orientation_xyzw;
    result.kinds_used |= after.kinds_used;
    return result;
}

std::vector<Smoother::Named> Smoother::backwards() {
    const Mirror mirror(poses_.front().pose.estimate.time, poses_.back().pose.estimate.time);
    Engine engine(settings_);
    std::vector<Named> found;
    Ticker ticker(engine, [&](std::span<const Pose> poses) {
        for (const Pose& pose : poses)
            if (is_publishable(pose))
                found.push_back({mirror.pose(pose), std::string{engine.target_name(pose.target_index)}});
    });
    std::vector<Measurement> mirrored;
    for (const Measurement& measurement : measurements_)
        if (const auto image = mirror.measurement(measurement)) mirrored.push_back(*image);
    one_way_ = measurements_.size() - mirrored.size();
    std::stable_sort(mirrored.begin(), mirrored.end(),
                     [](const Measurement& a, const Measurement& b) { return a.time < b.time; });
    for (const Measurement& measurement : mirrored) ticker.take(measurement, measurement.time);
    ticker.finish();
    return found;
}

void Smoother::finish(const std::function<void(const Pose&, const std::string&)>& take) {
    if (poses_.empty()) return;
    std::map<std::pair<std::string, Timestamp>, Estimate> after;
    for (const Named& named : backwards()) after[{named.target, named.pose.estimate.time}] = named.pose.estimate;
    for (Named& named : poses_) {
        const auto twin = after.find({named.target, named.pose.estimate.time});
        if (twin != after.end()) {
            named.pose.estimate = combined(named.pose.estimate, twin->second);
            bound(named.pose);
        }
        take(named.pose, named.target);
    }
}

} // namespace locus::replay
