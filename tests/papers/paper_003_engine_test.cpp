// The crowd of paper 003 through locusd's own engine: estimator radio_particles on strengths and feet, whose they are
// decided by the identity of cameras and tags. Figures that these print are in docs/papers.md.
#include "fusion/engine.h"
#include "fusion/estimators/radio_grid.h"
#include "fusion/estimators/radio_particles.h"
#include "fusion/radio/calibrated_map.h"
#include "tests/papers/crowd_world.h"

#include <Eigen/LU>

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <memory>

namespace {

using namespace locus;
using locus::test::CrowdWorld;

struct LiveErrors {
    double sum_m = 0, seen_sum_m = 0, unseen_sum_m = 0;
    double squared_in_sigma = 0;
    int count = 0, seen = 0, seen_below_half = 0, unseen = 0, named = 0, right = 0;

    double mean_m() const { return sum_m / count; }
    double unseen_m() const { return unseen_sum_m / std::max(1, unseen); }
    void add(double error_m, bool is_seen) {
        sum_m += error_m;
        ++count;
        (is_seen ? seen_sum_m : unseen_sum_m) += error_m;
        ++(is_seen ? seen : unseen);
        seen_below_half += is_seen && error_m < 0.5;
    }
};

/// What the daemon does besides: what it is asked to is on.
struct LiveParts {
    bool tags_hear_tags = true, map_learns = true;
};

EngineSettings crowd_settings(CrowdWorld& world) {
    EngineSettings settings;
    settings.fusion.estimator = "radio_particles";
    settings.fusion.rate_hz = 2;
    settings.cameras = 1;
    settings.vision.sigma_m = 2; // as docs/radio.md says for radios that are known to metres
    settings.vision.window_s = 4;
    settings.vision.keep_s = 100;
    RadioParticlesSettings radio;
    radio.body_share = 0.2; // as docs/radio.md says for a crowd
    radio.radio_map = std::make_shared<const radio::RadioMap>(world.radios.survey(world.width_m, world.depth_m, 2));
    radio.surveyed_map = radio.radio_map;
    radio.grid = std::make_shared<radio::GridInUse>();
    settings.estimators.push_back({&radio_particles_row, std::make_shared<RadioParticlesSettings>(radio)});
    for (std::size_t i = 0; i < world.places.size(); ++i)
        settings.targets.push_back({"p" + std::to_string(i), address(1000 + i), {}});
    return settings;
}

class LiveCrowd {
  public:
    LiveCrowd(CrowdWorld& world, const LiveParts& parts)
        : world_(world), parts_(parts), settings_(crowd_settings(world)), engine_(settings_),
          map_(*radio_settings().radio_map, {}) {}

    void frame(std::size_t seen_count, LiveErrors* errors) {
        const Timestamp time = timestamp_from_s(0.5 * ++frames_);
        for (std::size_t i = 0; i < world_.places.size(); ++i)
            for (const auto& heard : world_.hear(i))
                submit(time, SignalStrength{heard.beacon, address(1000 + i), static_cast<float>(heard.rssi_dbm)});
        for (std::size_t i = 0; parts_.tags_hear_tags && i < world_.places.size(); ++i)
            for (std::size_t j = 0; j < world_.places.size(); ++j)
                if (i != j)
                    submit(time, SignalStrength{address(1000 + j), address(1000 + i),
                                                static_cast<float>(world_.hear_tag(i, j))});
        for (std::size_t i = 0; i < seen_count; ++i) submit(time, foot(i));
        const auto poses = engine_.step(time + duration_from_s(0.05));
        if (parts_.map_learns) learn();
        if (errors == nullptr) return;
        for (std::size_t i = 0; i < poses.size(); ++i) score(poses[i], seen_count, *errors);
    }

  private:
    void submit(Timestamp time, const auto& observation) { engine_.submit({time, ++sequence_, 0, observation}, time); }

    const RadioParticlesSettings& radio_settings() const {
        return *static_cast<const RadioParticlesSettings*>(settings_.estimators[0].settings.get());
    }

    /// As daemon/radio/map_keeper.cpp does, here every ten seconds since the whole of it lasts two minutes.
    void learn() {
        for (const radio::Lesson& lesson : engine_.take_lessons())
            if (lesson.is_withdrawn)
                map_.take_back(lesson.course);
            else
                map_.learn(lesson.course, {lesson.position_site_m[0], lesson.position_site_m[1]}, {&lesson.reading, 1});
        if (frames_ % 20 != 0) return;
        auto next = map_grid(map_.map(), radio_settings().lost_share);
        radio_settings().grid->exchange(next);
    }

    FootPoint foot(std::size_t person) {
        const radio::SeenTrack seen = world_.see(person);
        FootPoint foot;
        foot.camera = address(0);
        foot.track = seen.track + 1;
        foot.position_site_m = {seen.position_site_m.x(), seen.position_site_m.y()};
        foot.covariance_m2 = {0.15F * 0.15F, 0, 0.15F * 0.15F};
        return foot;
    }

    void score(const Pose& pose, std::size_t seen_count, LiveErrors& errors) const {
        const auto person = static_cast<std::size_t>(number(pose.target) - 1000);
        const Vec3& at = pose.estimate.position_site_m;
        const Eigen::Vector2d truth = world_.places[person];
        errors.add(std::hypot(at[0] - truth.x(), at[1] - truth.y()), person < seen_count);
        const auto& c = pose.estimate.covariance;
        const Eigen::Matrix2d covariance{{c[0], c[1]}, {c[6], c[7]}};
        const Eigen::Vector2d off(at[0] - truth.x(), at[1] - truth.y());
        errors.squared_in_sigma += off.dot(covariance.inverse() * off);
        if (pose.seen_as.camera == no_address) return;
        ++errors.named;
        errors.right += pose.seen_as.track == person + 1;
    }

    CrowdWorld& world_;
    LiveParts parts_;
    EngineSettings settings_;
    Engine engine_;
    radio::CalibratedMap map_;
    int frames_ = 0;
    std::uint32_t sequence_ = 0;
};

/// As crowd() of paper_003_test.cpp: half a minute apart and in view, then a minute and a half in a cluster.
LiveErrors live_crowd(std::size_t people, std::size_t first_seen, std::size_t seen, const LiveParts& parts = {}) {
    LiveErrors errors;
    for (unsigned seed = 1; seed <= 4; ++seed) {
        CrowdWorld world(people, seed);
        LiveCrowd crowd(world, parts);
        for (int frame = 0; frame < 240; ++frame) {
            world.step(frame >= 60);
            crowd.frame(frame < 60 ? first_seen : seen, frame >= 80 ? &errors : nullptr);
        }
    }
    return errors;
}

using Situation003 = std::pair<std::size_t, std::size_t>; ///< people, seen

/// Quick ones, or with LOCUS_ALL_FRAMES=1 those of the paper, which take minutes.
std::vector<Situation003> situations() {
    if (!std::getenv("LOCUS_ALL_FRAMES")) return {{1, 1}, {3, 3}};
    return {{1, 1}, {3, 1}, {3, 2}, {3, 3}, {5, 1}, {5, 2}, {5, 3}, {5, 4}, {5, 5}};
}

/// What each part of it is worth, where two of five are seen. LOCUS_ALL_FRAMES=1 prints it for docs/papers.md.
TEST(Paper003Live, TagsThatHearTagsAndAMapThatLearnsHelpTheUnseen) {
    if (!std::getenv("LOCUS_ALL_FRAMES")) GTEST_SKIP() << "takes minutes: LOCUS_ALL_FRAMES=1 runs it";
    for (const bool tags_hear_tags : {false, true})
        for (const bool map_learns : {false, true}) {
            const LiveErrors errors = live_crowd(5, 5, 2, {tags_hear_tags, map_learns});
            std::printf("tags hear tags: %d, map learns: %d: seen %.2f m, unseen %.2f m\n", tags_hear_tags, map_learns,
                        errors.seen_sum_m / errors.seen, errors.unseen_m());
        }
}

TEST(Paper003Live, SeeingSomeOfThemImprovesAll) {
    double sum = 0, least = 1;
    LiveErrors all;
    int count = 0;
    for (const auto& [people, seen] : situations()) {
        const LiveErrors radio = live_crowd(people, 0, 0), both = live_crowd(people, people, seen);
        const double improvement = 1 - both.mean_m() / radio.mean_m();
        std::printf("%zu people, %zu seen: radio %.2f m, with the camera %.2f m (%.1f %%); seen %.2f m, %.1f %% below "
                    "0.5 m; unseen %.2f m; %.0f %% named, %.1f %% of names right; squared error over variance %.1f, "
                    "%.1f of 2\n",
                    people, seen, radio.mean_m(), both.mean_m(), 100 * improvement, both.seen_sum_m / both.seen,
                    100.0 * both.seen_below_half / both.seen, both.unseen_m(), 100.0 * both.named / both.seen,
                    100.0 * both.right / both.named, radio.squared_in_sigma / radio.count,
                    both.squared_in_sigma / both.count);
        sum += improvement;
        least = std::min(least, improvement);
        all.seen += both.seen;
        all.seen_below_half += both.seen_below_half;
        all.named += both.named;
        all.right += both.right;
        ++count;
    }
    std::printf("improvement %.1f %% in the mean, least %.1f %%; seen: %.1f %% below 0.5 m; names %.1f %% right\n",
                100 * sum / count, 100 * least, 100.0 * all.seen_below_half / all.seen, 100.0 * all.right / all.named);
    EXPECT_GE(sum / count, 0.35);
    EXPECT_GE(least, 0.1);
    EXPECT_GT(all.right, 0.95 * all.named);
}

} // namespace
