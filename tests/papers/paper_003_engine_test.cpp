// The crowd of paper 003 through locusd's own engine: estimator radio_particles on strengths and feet, whose they are
// decided by the identity of cameras and tags. Figures that these print are in docs/papers.md.
#include "fusion/engine.h"
#include "fusion/estimators/radio_grid.h"
#include "fusion/estimators/radio_particles.h"
#include "fusion/radio/calibrated_map.h"
#include "tests/papers/crowd_world.h"

#include <Eigen/LU>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <random>
#include <vector>

namespace {

using namespace locus;
using locus::test::CrowdWorld;

/// So that among 19 people a third of the looks are more like somebody else's, as in PETS 2009 (docs/cameras.md).
constexpr double alike_of_coats = 1, noise_of_coats = 0.9;

/// How the feet are named, and what troubles the tracker.
struct Camera003 {
    const char* name = "hungarian";
    const char* association = "hungarian";
    double looks_weight = 0;
    bool shows_looks = false;
    bool troubled = false; ///< tracks break and swap
    double trajectory_share = 0.5;
    bool tags_hear_tags = false, map_learns = false;
};

struct LiveErrors {
    double sum_m = 0, seen_sum_m = 0, unseen_sum_m = 0;
    double squared_in_sigma = 0;
    int count = 0, seen = 0, seen_below_half = 0, unseen = 0, named = 0, right = 0;

    double mean_m() const { return sum_m / count; }
    double seen_m() const { return seen_sum_m / std::max(1, seen); }
    double unseen_m() const { return unseen_sum_m / std::max(1, unseen); }
    void add(double error_m, bool is_seen) {
        sum_m += error_m;
        ++count;
        (is_seen ? seen_sum_m : unseen_sum_m) += error_m;
        ++(is_seen ? seen : unseen);
        seen_below_half += is_seen && error_m < 0.5;
    }
    void append(const LiveErrors& more) {
        sum_m += more.sum_m;
        seen_sum_m += more.seen_sum_m;
        unseen_sum_m += more.unseen_sum_m;
        squared_in_sigma += more.squared_in_sigma;
        count += more.count;
        seen += more.seen;
        seen_below_half += more.seen_below_half;
        unseen += more.unseen;
        named += more.named;
        right += more.right;
    }
};

EngineSettings crowd_settings(CrowdWorld& world, const Camera003& camera) {
    EngineSettings settings;
    settings.fusion.estimator = "radio_particles";
    settings.fusion.rate_hz = 2;
    settings.cameras = 1;
    settings.vision.sigma_m = 2; // as docs/radio.md says for radios that are known to metres
    settings.vision.window_s = 4;
    settings.vision.keep_s = 100;
    settings.vision.association = camera.association;
    settings.vision.looks_weight = camera.looks_weight;
    settings.vision.trajectory_share = camera.trajectory_share;
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

/// The numbers under which a tracker knows people: half a minute after the last time somebody is lost for up to two
/// seconds and found again under a new one; and of two who are within half a metre at one frame in fifty the numbers go
/// on with the other.
class TrackNumbers {
  public:
    TrackNumbers(std::size_t people, unsigned seed) : random_(seed), of_(people), lost_frames_(people, 0) {
        for (auto& number : of_) number = ++last_;
    }

    void step(const CrowdWorld& world) {
        for (std::size_t i = 0; i < of_.size(); ++i) {
            if (lost_frames_[i] > 0) --lost_frames_[i];
            if (uniform() < CrowdWorld::frame_s / 30) {
                of_[i] = ++last_;
                lost_frames_[i] = static_cast<int>(5 * uniform());
            }
            for (std::size_t j = 0; j < i; ++j)
                if ((world.places[i] - world.places[j]).norm() < 0.5 && uniform() < 0.02) std::swap(of_[i], of_[j]);
        }
    }
    bool shows(std::size_t person) const { return lost_frames_[person] == 0; }
    std::uint32_t of(std::size_t person) const { return of_[person]; }
    bool exists(std::uint32_t number) const { return std::ranges::find(of_, number) != of_.end(); }

  private:
    double uniform() { return std::uniform_real_distribution<double>(0, 1)(random_); }

    std::mt19937 random_;
    std::vector<std::uint32_t> of_;
    std::vector<int> lost_frames_;
    std::uint32_t last_ = 0;
};

class LiveCrowd {
  public:
    LiveCrowd(CrowdWorld& world, const Camera003& camera, unsigned seed)
        : world_(world), camera_(camera), numbers_(world.places.size(), seed), settings_(crowd_settings(world, camera)),
          engine_(settings_), map_(*radio_settings().radio_map, {}) {}

    void frame(std::size_t seen_count, LiveErrors* errors) {
        const Timestamp time = timestamp_from_s(0.5 * ++frames_);
        if (camera_.troubled) numbers_.step(world_);
        for (std::size_t i = 0; i < world_.places.size(); ++i)
            for (const auto& heard : world_.hear(i))
                submit(time, SignalStrength{heard.beacon, address(1000 + i), static_cast<float>(heard.rssi_dbm)});
        for (std::size_t i = 0; camera_.tags_hear_tags && i < world_.places.size(); ++i)
            for (std::size_t j = 0; j < world_.places.size(); ++j)
                if (i != j)
                    submit(time, SignalStrength{address(1000 + j), address(1000 + i),
                                                static_cast<float>(world_.hear_tag(i, j))});
        for (std::size_t i = 0; i < seen_count; ++i) {
            const FootPoint seen = foot(i); // drawn in any case, so that the world goes on alike
            if (numbers_.shows(i)) submit(time, seen);
        }
        const auto poses = engine_.step(time + duration_from_s(0.05));
        if (camera_.map_learns) learn();
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
        for (const radio::Lesson& lesson : engine_.take_lessons()) map_.heed(lesson);
        if (frames_ % 20 != 0) return;
        auto next = map_grid(map_.map(), radio_settings().lost_share);
        radio_settings().grid->exchange(next);
    }

    FootPoint foot(std::size_t person) {
        const vision::SeenPerson seen = world_.see(person);
        FootPoint foot;
        foot.camera = address(0);
        foot.track = numbers_.of(person);
        foot.position_site_m = {seen.position_site_m.x(), seen.position_site_m.y()};
        foot.covariance_m2 = {0.15F * 0.15F, 0, 0.15F * 0.15F};
        if (camera_.shows_looks) foot.looks = seen.looks;
        return foot;
    }

    /// Of names, those of tracks count that go on.
    void score(const Pose& pose, std::size_t seen_count, LiveErrors& errors) const {
        const auto person = static_cast<std::size_t>(number(pose.target) - 1000);
        const Vec3& at = pose.estimate.position_site_m;
        const Eigen::Vector2d truth = world_.places[person];
        errors.add(std::hypot(at[0] - truth.x(), at[1] - truth.y()), person < seen_count);
        const auto& c = pose.estimate.covariance;
        const Eigen::Matrix2d covariance{{c[0], c[1]}, {c[6], c[7]}};
        const Eigen::Vector2d off(at[0] - truth.x(), at[1] - truth.y());
        errors.squared_in_sigma += off.dot(covariance.inverse() * off);
        if (pose.seen_as.camera == no_address || !numbers_.exists(pose.seen_as.track)) return;
        ++errors.named;
        errors.right += pose.seen_as.track == numbers_.of(person);
    }

    CrowdWorld& world_;
    Camera003 camera_;
    TrackNumbers numbers_;
    EngineSettings settings_;
    Engine engine_;
    radio::CalibratedMap map_;
    int frames_ = 0;
    std::uint32_t sequence_ = 0;
};

/// As crowd() of paper_003_test.cpp: half a minute apart and in view, then a minute and a half in a cluster.
LiveErrors live_crowd(std::size_t people, std::size_t first_seen, std::size_t seen, const Camera003& camera = {},
                      unsigned seeds = 4) {
    LiveErrors errors;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        CrowdWorld world(people, seed);
        world.alike = alike_of_coats;
        world.look_noise = noise_of_coats;
        LiveCrowd crowd(world, camera, seed);
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

struct Improvement {
    double mean = 0, least = 1;
    LiveErrors all;
};

Improvement improvement_by(const Camera003& camera) {
    Improvement found;
    const auto run = situations();
    for (const auto& [people, seen] : run) {
        const LiveErrors radio = live_crowd(people, 0, 0), both = live_crowd(people, people, seen, camera);
        const double improvement = 1 - both.mean_m() / radio.mean_m();
        std::printf("%zu people, %zu seen: radio %.2f m, with the camera %.2f m (%.1f %%); seen %.2f m, %.1f %% below "
                    "0.5 m; unseen %.2f m; %.0f %% named, %.1f %% of names right; squared error over variance %.1f, "
                    "%.1f of 2\n",
                    people, seen, radio.mean_m(), both.mean_m(), 100 * improvement, both.seen_m(),
                    100.0 * both.seen_below_half / both.seen, both.unseen_m(), 100.0 * both.named / both.seen,
                    100.0 * both.right / both.named, radio.squared_in_sigma / radio.count,
                    both.squared_in_sigma / both.count);
        found.mean += improvement / static_cast<double>(run.size());
        found.least = std::min(found.least, improvement);
        found.all.append(both);
    }
    std::printf("%s: improvement %.1f %% in the mean, least %.1f %%; seen: %.1f %% below 0.5 m; names %.1f %% right\n",
                camera.name, 100 * found.mean, 100 * found.least, 100.0 * found.all.seen_below_half / found.all.seen,
                100.0 * found.all.right / found.all.named);
    return found;
}

TEST(Paper003Live, SeeingSomeOfThemImprovesAll) {
    const Improvement found = improvement_by({});
    EXPECT_GE(found.mean, 0.35);
    EXPECT_GE(found.least, 0.1);
    EXPECT_GT(found.all.right, 0.95 * found.all.named);
}

TEST(Paper003Live, LooksImproveAllFurther) {
    const Improvement found = improvement_by({"looks_weight 3", "hungarian", 3, true});
    EXPECT_GE(found.mean, 0.411);
    EXPECT_GT(found.all.right, 0.95 * found.all.named);
}

LiveErrors print_troubled(Camera003 camera, bool troubled) {
    const bool all_situations = std::getenv("LOCUS_ALL_FRAMES") != nullptr;
    camera.troubled = troubled;
    LiveErrors all;
    for (const auto& [people, seen] :
         all_situations ? std::vector<Situation003>{{3, 3}, {5, 3}, {5, 5}} : std::vector<Situation003>{{3, 3}})
        all.append(live_crowd(people, people, seen, camera, all_situations ? 4 : 2));
    std::printf("%s%s: seen %.2f m, unseen %.2f m; %.0f %% named, %.1f %% of names right, so %.0f %% of those seen\n",
                camera.name, troubled ? ", tracks break and swap" : "", all.seen_m(), all.unseen_m(),
                100.0 * all.named / all.seen, 100.0 * all.right / std::max(1, all.named), 100.0 * all.right / all.seen);
    return all;
}

/// What each part of it is worth, where two of five are seen. LOCUS_ALL_FRAMES=1 prints it for docs/papers.md.
TEST(Paper003Live, TagsThatHearTagsAndAMapThatLearns) {
    if (!std::getenv("LOCUS_ALL_FRAMES")) GTEST_SKIP() << "takes minutes: LOCUS_ALL_FRAMES=1 runs it";
    for (const bool tags_hear_tags : {false, true})
        for (const bool map_learns : {false, true}) {
            Camera003 camera;
            camera.tags_hear_tags = tags_hear_tags;
            camera.map_learns = map_learns;
            const LiveErrors errors = live_crowd(5, 5, 2, camera);
            std::printf("tags hear tags: %d, map learns: %d: seen %.2f m, unseen %.2f m\n", tags_hear_tags, map_learns,
                        errors.seen_m(), errors.unseen_m());
        }
}

TEST(Paper003Live, AllOfItTogether) {
    Camera003 camera{"looks_weight 3, tags that hear tags, a map that learns", "hungarian", 3, true};
    camera.tags_hear_tags = camera.map_learns = true;
    const Improvement found = improvement_by(camera);
    EXPECT_GE(found.mean, 0.411);
    EXPECT_GT(found.all.right, 0.95 * found.all.named);
}

/// Who still knows whom when tracks break and swap.
TEST(Paper003Live, LooksTellWhoIsWhoAgain) {
    const Camera003 plain{}, looks{"hungarian, looks_weight 3", "hungarian", 3, true};
    const Camera003 matrix{"matrix", "matrix", 0, true};
    if (std::getenv("LOCUS_ALL_FRAMES") != nullptr) {
        for (const Camera003& camera : {plain, looks, matrix}) print_troubled(camera, false);
        print_troubled({"hungarian, looks_weight 10", "hungarian", 10, true}, true);
        print_troubled({"matrix without looks", "matrix"}, true);
        print_troubled({"matrix, trajectory_share 0.2", "matrix", 0, true, false, 0.2}, true);
    }
    const LiveErrors without = print_troubled(plain, true), with = print_troubled(looks, true);
    const LiveErrors paper = print_troubled(matrix, true);
    EXPECT_GT(with.right, without.right);
    EXPECT_LT(with.seen_m(), without.seen_m());
    EXPECT_GT(with.right, paper.right);
}

} // namespace
