// Paper 000 (Peng et al., Sensors 2022, 22, 1394), the radio part: an indoor walk past four base stations, differences
// of arrival, Chan-Taylor, and behind it a plain, an augmented and a principal-component Kalman filter. The paper
// states neither the noise nor the size of the corridor: the noise is that of walk.h, the corridor is 20 m long and as
// wide (5 m) as gives the mean error of the paper's raw positions.
#include "fusion/estimators/chan_taylor.h"
#include "fusion/estimators/kalman.h"
#include "fusion/estimators/range_ekf.h"
#include "tests/papers/posts.h"
#include "tests/papers/score.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

namespace locus::papers {
namespace {

const Site corridor = site_of({{0, 0, 2.5}, {20, 0, 2.5}, {20, 5, 2.5}, {0, 5, 2.5}});
const Way straight{{1, 2.5}, {19, 2.5}};
const Way rectangle{{1, 0.5}, {19, 0.5}, {19, 4.5}, {1, 4.5}};

constexpr double rate_hz = 10;
constexpr double walk_s = 60;
constexpr double settled_s = 3;
constexpr unsigned walks = 10; // seeds 1 to 10

enum Who { fixes, kalman, augmented, pca, ours, who_count };
using Scores = std::array<Score, who_count>;

std::array<std::unique_ptr<Estimator>, who_count> estimators(double velocity_walk) {
    KalmanSettings plain;
    plain.velocity_walk = velocity_walk;
    ColouredKalmanSettings coloured;
    coloured.velocity_walk = velocity_walk;
    PcaKalmanSettings principal;
    principal.velocity_walk = velocity_walk;
    return {planar("chan_taylor", corridor, ChanTaylorSettings{}), planar("kalman", corridor, plain),
            planar("coloured_kalman", corridor, coloured), planar("pca_kalman", corridor, principal),
            planar("range_ekf", corridor, RangeEkfSettings{})};
}

void walk(const Way& way, const Noise& noise, double velocity_walk, unsigned seed, Scores& scores,
          const Blocked& blocked = {}) {
    const Walker walker(way);
    Radio radio(corridor, noise, seed);
    auto all = estimators(velocity_walk);
    for (int i = 0; i < walk_s * rate_hz; ++i) {
        const double time_s = 1 + i / rate_hz;
        const Eigen::Vector3d truth_m = walker.position_m(time_s);
        const auto heard = differences(corridor, radio.hear(truth_m, time_s, blocked), time_s);
        for (std::size_t who = 0; who < who_count; ++who) {
            for (const Measurement& m : heard) all[who]->update(m);
            if (time_s > 1 + settled_s) scores[who].add(all[who]->predict(timestamp_from_s(time_s)), truth_m);
        }
    }
}

Scores walk_often(const Way& way, const Noise& noise, double velocity_walk) {
    Scores scores;
    for (unsigned seed = 1; seed <= walks; ++seed) walk(way, noise, velocity_walk, seed, scores);
    return scores;
}

/// Mean square error less that of the plain filter, in its percents.
double change_percent(const Scores& scores, Who who) {
    return 100 * (scores[who].mse_m2() / scores[kalman].mse_m2() - 1);
}

void print(const char* what, const Noise& noise, double velocity_walk, const Scores& s) {
    std::printf("| %s | %.1f | %.1f | %.3f | %.3f | %.3f (%+.1f %%) | %.3f (%+.1f %%) | %.3f (%+.1f %%) |\n", what,
                noise.held_s, velocity_walk, s[fixes].rmse_m(), s[kalman].rmse_m(), s[augmented].rmse_m(),
                change_percent(s, augmented), s[pca].rmse_m(), change_percent(s, pca), s[ours].rmse_m(),
                change_percent(s, ours));
}

// The paper: mean square error 31.8 % below the plain filter's, and below the augmented one's.
TEST(Paper000, PcaKalmanUnderColouredNoise) {
    std::puts("| walk | held for s | velocity walk | fixes m | kalman m | augmented | pca | range_ekf |");
    const double usual = KalmanSettings{}.velocity_walk;
    const Scores scores = walk_often(straight, {}, usual);
    print("there and back", {}, usual, scores);
    print("there and back", {}, 0.3, walk_often(straight, {}, 0.3));
    print("rectangle", {}, usual, walk_often(rectangle, {}, usual));
    print("rectangle", {}, 0.3, walk_often(rectangle, {}, 0.3));
    for (const double held_s : {1.0, 3.0}) {
        Noise noise;
        noise.held_s = held_s;
        print("there and back", noise, usual, walk_often(straight, noise, usual));
        print("rectangle", noise, usual, walk_often(rectangle, noise, usual));
    }
    EXPECT_EQ(scores[pca].none, 0);
    EXPECT_LE(change_percent(scores, pca), -31.8);
    EXPECT_LT(scores[pca].mse_m2(), scores[augmented].mse_m2());
    EXPECT_LT(scores[augmented].mse_m2(), scores[kalman].mse_m2());
}

struct Scheme {
    int people;
    int obstacles;
    double paper_cm; ///< mean error of UWB positioning
};
// Table 1. How long the camera lost somebody, its third column, does nothing to the radio.
constexpr Scheme schemes[]{{2, 0, 33.25}, {1, 0, 30.89}, {1, 0, 32.23}, {1, 0, 33.99}, {1, 2, 36.58}, {1, 3, 38.56}};
const Way obstacles{{6, 3.1}, {13, 1.9}, {16, 3.1}};

Scores scheme_scores(const Scheme& scheme, unsigned seed) {
    Scores scores;
    const Way standing(obstacles.begin(), obstacles.begin() + scheme.obstacles);
    for (int person = 0; person < scheme.people; ++person)
        walk(person == 0 ? straight : rectangle, {}, KalmanSettings{}.velocity_walk,
             seed + static_cast<unsigned>(person), scores, posts(standing));
    return scores;
}

// The first rows are what the corridor's width was chosen for; what is measured is the rise with the obstacles, and
// what filters leave of it.
TEST(Paper000, MeanErrorOfUwbInTable1) {
    std::puts("| scheme | people | obstacles | paper, UWB cm | chan_taylor cm | kalman | pca_kalman | range_ekf |");
    double free_m = 0, blocked_m = 0;
    unsigned seed = 100;
    for (const Scheme& scheme : schemes) {
        const Scores s = scheme_scores(scheme, seed += 10);
        (scheme.obstacles ? blocked_m : free_m) += s[fixes].mean_m() / (scheme.obstacles ? 2 : 4);
        std::printf("| %ld | %d | %d | %.2f | %.2f | %.2f | %.2f | %.2f |\n", &scheme - schemes + 1, scheme.people,
                    scheme.obstacles, scheme.paper_cm, 100 * s[fixes].mean_m(), 100 * s[kalman].mean_m(),
                    100 * s[pca].mean_m(), 100 * s[ours].mean_m());
        EXPECT_LT(s[ours].mean_m(), s[fixes].mean_m()) << "scheme " << &scheme - schemes + 1;
    }
    EXPECT_NEAR(free_m, 0.326, 0.03) << "mean of the paper's rows without obstacles";
    EXPECT_NEAR(blocked_m, 0.376, 0.05) << "mean of its rows with obstacles";
}

} // namespace
} // namespace locus::papers
