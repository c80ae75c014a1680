// Ranges between people through the engine: what one learns from another, and what none may make of it.
#include "fusion/estimators/walker_particles.h"
#include "fusion/filter/covariance_intersection.h"
#include "tests/unit/fusion/inertial/simulated_team.h"

#include <gtest/gtest.h>

namespace locus::team {
namespace {

using test::Excess;
using test::SimulatedTeam;
using test::team_size;
using test::TeamModel;

EngineSettings hall() {
    EngineSettings settings;
    settings.fusion.estimator = "walker_particles";
    settings.fusion.max_targets = team_size;
    settings.fusion.lost_after_s = 3600;
    const Vec3 corners[]{{0, 0, 1.2}, {40, 0, 1.2}, {40, 30, 1.2}, {0, 30, 1.2}};
    for (const Vec3& corner : corners)
        settings.site.anchors.push_back({"", address(settings.site.anchors.size()), corner});
    auto walkers = std::make_shared<WalkerParticlesSettings>();
    walkers->anchor_error_sigma_m = 0; // the simulated noise is white
    walkers->height_sigma_m = 0.01;
    settings.estimators.push_back({&walker_particles_row, walkers});
    return settings;
}

std::array<Eigen::Vector2d, team_size> spread_out() { return {{{8, 8}, {13, 8}, {10, 12}}}; }

const Excess clear = [](std::size_t, std::size_t) { return 0.0; };
const Excess silent = [](std::size_t, std::size_t) { return std::nan(""); };

/// Ten seconds with anchors, then thirty without in which everyone ranges everyone five times a second. If news went
/// round in loops and were taken for new, the NEES would grow with every round; covariance intersection may be too
/// careful but not too sure. Upper end: 2 degrees of freedom, 20 runs of 3 people whose errors hardly change within a
/// run and are common to the three in part: 20 to 60 independent ones, so 2 + 3 * sqrt(4 / 20) at most.
TEST(Team, DoesNotBecomeSurerThanTheTruth) {
    for (const bool peers : {false, true}) {
        double nees = 0, squares = 0;
        int scored = 0;
        for (unsigned seed = 1; seed <= 20; ++seed) {
            TeamModel model;
            model.walker.rate_hz = 50;
            model.peers = peers;
            SimulatedTeam team(hall(), model, seed, spread_out(), 0.4);
            for (int i = 0; i < 100; ++i) team.move({0, 0, 0}, false, clear);
            for (int i = 0; i < 500; ++i) team.move({0.1, 0.1, 0.1}, true, clear);
            for (int i = 1; i <= 1500; ++i) {
                team.move({0.1, 0.1, 0.1}, true, silent);
                if (i % 100 != 0) continue;
                for (std::size_t m = 0; m < team_size; ++m, ++scored) {
                    nees += team.squared_in_sigma(m);
                    squares += team.error_m(m).squaredNorm();
                }
            }
        }
        std::printf("30 s without anchors, %s: NEES %.2f, RMSE %.2f m\n", peers ? "ranging each other" : "each alone",
                    nees / scored, std::sqrt(squares / scored));
        EXPECT_LT(nees / scored, 3.4) << peers;
        EXPECT_GT(nees / scored, 0.2) << peers;
    }
}

/// One of three hears no anchor for half a minute; the two others, who do, tell where he is.
TEST(Team, HelpsTheOneWhoHearsNoAnchor) {
    double squares[2]{};
    for (const bool peers : {false, true})
        for (unsigned seed = 1; seed <= 10; ++seed) {
            TeamModel model;
            model.walker.rate_hz = 50;
            model.peers = peers;
            SimulatedTeam team(hall(), model, seed, spread_out(), 0.4);
            for (int i = 0; i < 100; ++i) team.move({0, 0, 0}, false, clear);
            for (int i = 0; i < 500; ++i) team.move({0.1, 0.1, 0.1}, true, clear);
            const Excess first_hears_none = [](std::size_t, std::size_t who) { return who == 0 ? std::nan("") : 0.0; };
            for (int i = 0; i < 1500; ++i) {
                team.move({0.1, 0.1, 0.1}, true, first_hears_none);
                squares[peers] += team.error_m(0).squaredNorm() / 15000;
            }
        }
    std::printf("no anchor heard for 30 s: %.2f m alone, %.2f m with the others\n", std::sqrt(squares[0]),
                std::sqrt(squares[1]));
    EXPECT_LT(std::sqrt(squares[1]), 0.5 * std::sqrt(squares[0]));
}

/// An anchor's ranges come a tick and a half late, so that every tick rolls back and hears the peers' ranges again:
/// with the beliefs that came with them, so two engines that hear the same say the same, to the bit.
TEST(Team, ARollBackHearsThePeersAsBefore) {
    const auto run = [](Engine& engine) {
        std::uint32_t sequence = 0;
        Vec3 last{};
        for (int i = 1; i <= 200; ++i) {
            const auto now = timestamp_from_s(1 + 0.01 * i);
            for (std::uint64_t tag = 0; tag < 2; ++tag)
                for (std::uint64_t a = 0; a < 4; ++a) {
                    const Vec3& p = engine.settings().site.anchors[a].position_site_m;
                    const double away_m = std::hypot(p[0] - 10 - 3.0 * static_cast<double>(tag), p[1] - 9);
                    const auto late = duration_from_s(a == 3 ? 0.015 : 0);
                    engine.submit({now - late, ++sequence, 0, Range{address(a), test::member(tag), away_m}}, now);
                }
            engine.submit({now, ++sequence, 0, PeerRange{test::member(0), test::member(1), 3.0}}, now);
            for (const Pose& pose : engine.step(now)) last = pose.estimate.position_site_m;
        }
        return last;
    };
    Engine engine(hall()), again(hall());
    EXPECT_EQ(run(engine), run(again));
    EXPECT_GT(engine.counters().rolled_back, 100u);
}

TEST(Team, SaysWhyAPeerIsOfNoUse) {
    Engine engine(hall());
    const auto t = timestamp_from_s(1);
    engine.submit({t, 1, 0, PeerRange{test::member(0), test::member(1), 3.0}}, t);
    engine.step(t);
    EXPECT_EQ(engine.counters().by_reason[static_cast<std::size_t>(Exclusion::waiting_for_start)], 2u);
}

/// Two who know the very same, to the bit: a hundred exchanges may not make the variance less than it is.
TEST(Intersection, MakesNothingOutOfWhatWasOnesOwn) {
    double variance = 1;
    for (int i = 0; i < 100; ++i) {
        const auto part = filter::intersect(variance, variance * variance, variance, variance);
        if (!part.worth()) continue;
        const double widened = variance / part.own;
        variance = widened - widened * widened / (widened + variance / (1 - part.own));
    }
    EXPECT_GE(variance, 1 - 1e-12);
}

TEST(Intersection, TakesGoodNewsAndLeavesBad) {
    EXPECT_LT(filter::intersect(1, 1, 1, 0.01).own, 0.1);
    EXPECT_FALSE(filter::intersect(1, 1, 1, 100).worth());
}

} // namespace
} // namespace locus::team
