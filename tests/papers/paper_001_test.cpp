// Paper 001 (Sensors 2020, 20, 1139), section 2.1: an extended Kalman filter of nine states on ranges; RMSE in the
// plane 0.32 m in a room and 0.30 m in a corridor 3 m wide. Here four anchors in the corners of 20 m of such a
// corridor, ranges five times a second, a person who walks there and back. Two kinds of noise: 10 cm and white, as the
// paper's table 2 says of the device, and that of walk.h with the person's body in the way of the anchors behind. The
// paper takes the error to the nearest point of the route; here it is to the truth, and the other beside it.
#include "fusion/estimators/chan_taylor.h"
#include "fusion/estimators/range_ekf.h"
#include "tests/papers/score.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace locus::papers {
namespace {

constexpr double jerk = 1; ///< of a person who turns, m/s^2 per root of a second; the paper states none

/// The filter by the paper's words: constant acceleration, white noise, no robust weights, no errors that stay.
RangeEkfSettings by_the_letter() {
    RangeEkfSettings settings;
    settings.anchor_error_sigma_m = 0;
    settings.anchor_offset_sigma_m = 0;
    settings.common_range_error_sigma_m = 0;
    settings.acceleration_time_s = 1e3;
    settings.acceleration_sigma_mps2 = jerk * std::sqrt(0.5 * settings.acceleration_time_s);
    settings.robust_scale = 1e6;
    settings.gate_false_alarm = 1e-12;
    return settings;
}

struct Result {
    Score to_truth, to_route;
};
using Results = std::array<Result, 3>; // chan_taylor, by the letter, range_ekf

/// Nearest point of a closed route.
Eigen::Vector3d nearest(const Way& way, const Eigen::Vector3d& p) {
    Eigen::Vector3d best = Eigen::Vector3d::Constant(1e9);
    for (std::size_t i = 0; i < way.size(); ++i) {
        const Eigen::Vector2d leg = way[(i + 1) % way.size()] - way[i];
        const double share = std::clamp((p.head<2>() - way[i]).dot(leg) / leg.squaredNorm(), 0.0, 1.0);
        const Eigen::Vector2d at = way[i] + share * leg;
        const Eigen::Vector3d candidate(at.x(), at.y(), p.z());
        if ((candidate - p).norm() < (best - p).norm()) best = candidate;
    }
    return best;
}

struct Scene {
    const char* name;
    double paper_m;
    Site site;
    Way way;
};
const Scene scenes[]{
    {"corridor", 0.30, site_of({{0, 0, 2.5}, {20, 0, 2.5}, {20, 3, 2.5}, {0, 3, 2.5}}), {{1, 1.5}, {19, 1.5}}},
    {"room", 0.32, site_of({{0, 0, 2.5}, {8, 0, 2.5}, {8, 6, 2.5}, {0, 6, 2.5}}), {{1, 1}, {7, 1}, {7, 5}, {1, 5}}}};

Blocked body_of(const Walker& walker) {
    return [&](const Eigen::Vector3d& tag_m, const Eigen::Vector3d& anchor_m, double time_s) {
        const bool behind = (anchor_m - tag_m).normalized().dot(walker.direction(time_s)) < -0.5;
        return behind ? blocked_longer_m : 0;
    };
}

void walk(const Scene& scene, bool clean, unsigned seed, Results& results) {
    const Site& site = scene.site;
    const Walker walker(scene.way);
    Radio radio(site, clean ? Noise{0.1, 0, 1} : Noise{}, seed);
    const Blocked body = clean ? Blocked{} : body_of(walker);
    const std::array all{planar("chan_taylor", site, ChanTaylorSettings{}), planar("range_ekf", site, by_the_letter()),
                         planar("range_ekf", site, RangeEkfSettings{})};
    for (double time_s = 1; time_s < 61; time_s += 0.2) {
        const Eigen::Vector3d truth_m = walker.position_m(time_s);
        const auto heard = ranges(site, radio.hear(truth_m, time_s, body), time_s);
        for (std::size_t who = 0; who < all.size(); ++who) {
            for (const Measurement& m : heard) all[who]->update(m);
            if (time_s < 4) continue;
            const Estimate estimate = all[who]->predict(timestamp_from_s(time_s));
            results[who].to_truth.add(estimate, truth_m);
            results[who].to_route.add(estimate, nearest(scene.way, vector(estimate.position_site_m)));
        }
    }
}

Results walk_often(const Scene& scene, bool clean) {
    Results results;
    for (unsigned seed = 1; seed <= 20; ++seed) walk(scene, clean, seed, results);
    return results;
}

void print(const Scene& scene, bool clean, const Results& results) {
    std::printf("| %s, %s | %.2f |", scene.name, clean ? "10 cm, white" : "walk.h and a body", scene.paper_m);
    for (const Result& r : results) std::printf(" %.3f / %.3f |", r.to_truth.rmse_m(), r.to_route.rmse_m());
    std::puts("");
}

TEST(Paper001, UwbAlone) {
    std::puts("| scene | paper, RMSE m | chan_taylor, to truth / to route m | by the letter | range_ekf |");
    for (const Scene& scene : scenes) {
        const Results clean = walk_often(scene, true), rough = walk_often(scene, false);
        print(scene, true, clean);
        print(scene, false, rough);
        EXPECT_LE(clean[2].to_truth.rmse_m(), 0.30) << scene.name;
        EXPECT_LT(rough[2].to_truth.rmse_m(), rough[1].to_truth.rmse_m()) << scene.name;
        for (const Result& r : rough) EXPECT_EQ(r.to_truth.none, 0) << scene.name;
    }
}

} // namespace
} // namespace locus::papers
