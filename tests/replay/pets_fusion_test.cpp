// PETS 2009 S2.L1 through the engine itself: ranges simulated for the annotated people and foot points of the tracker
// on the public detections (pets_scene.h), submitted as they would come, the images 80 ms late. Who is whose, and how
// far off UWB alone, vision alone, the federated filter and the default are. Figures are in docs/cameras.md.
#include "fusion/engine.h"
#include "fusion/estimators/chan_taylor.h"
#include "fusion/estimators/federated.h"
#include "fusion/estimators/inertial_ekf.h"
#include "tests/replay/pets_detections.h"
#include "tests/replay/pets_ranges.h"
#include "tests/replay/pets_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace locus::test {
namespace {

constexpr double tick_s = 0.02, image_late_s = 0.08, range_late_s = 0.005, warm_s = 2;

struct Arriving {
    Timestamp arrival;
    Measurement measurement;
};

std::vector<Arriving> as_they_come(const PetsRanges& ranges, const std::vector<PetsImage>& images, bool with_images) {
    std::vector<Arriving> all;
    for (const Measurement& m : ranges.all) all.push_back({m.time + duration_from_s(range_late_s), m});
    for (const PetsImage& image : images)
        for (const Measurement& m : image.feet)
            if (with_images) all.push_back({m.time + duration_from_s(image_late_s), m});
    for (std::size_t i = 0; i < all.size(); ++i) all[i].measurement.sequence = static_cast<std::uint32_t>(i);
    std::sort(all.begin(), all.end(), [](const Arriving& a, const Arriving& b) {
        return std::pair(a.arrival, a.measurement.sequence) < std::pair(b.arrival, b.measurement.sequence);
    });
    return all;
}

struct Errors {
    std::vector<double> all_m;
    std::size_t covered = 0, none = 0;
    double mean_m() const {
        double sum = 0;
        for (const double e : all_m) sum += e;
        return sum / static_cast<double>(all_m.size());
    }
    double share_m(double share) {
        std::sort(all_m.begin(), all_m.end());
        return all_m[static_cast<std::size_t>(share * static_cast<double>(all_m.size() - 1))];
    }
    void add(const Errors& other) {
        all_m.insert(all_m.end(), other.all_m.begin(), other.all_m.end());
        covered += other.covered;
        none += other.none;
    }
    void print(const char* name) {
        std::printf("| %s | %.3f | %.3f | %.3f | %.1f %% | %zu |\n", name, mean_m(), share_m(0.8), share_m(1),
                    100. * static_cast<double>(covered) / static_cast<double>(all_m.size()), none);
    }
};

/// Person-frames in which the tracker has a box of somebody.
struct Names {
    std::size_t frames = 0, right = 0, wrong = 0;
    double longest_wrong_s = 0;
    double right_share() const { return static_cast<double>(right) / static_cast<double>(frames); }
    double wrong_share() const { return static_cast<double>(wrong) / static_cast<double>(frames); }
    void add(const Names& other) {
        frames += other.frames;
        right += other.right;
        wrong += other.wrong;
        longest_wrong_s = std::max(longest_wrong_s, other.longest_wrong_s);
    }
};

struct PetsOutcome {
    Errors errors;
    Names names, settled; ///< of people in the scene for 2 s; and also of tracks that are 2 s old
    void add(const PetsOutcome& other) {
        errors.add(other.errors);
        names.add(other.names);
        settled.add(other.settled);
    }
};

class PetsRun {
  public:
    PetsRun(const PetsScene& scene, const std::vector<PetsImage>& images, EngineSettings settings)
        : scene_(scene), images_(images), engine_(std::move(settings)) {}

    PetsOutcome run(const std::vector<Arriving>& all) {
        std::size_t next = 0, frame = 0;
        const double end_s = pets_time_s(images_.size());
        for (int i = 0; pets_start_s + tick_s * i < end_s; ++i) {
            const double now_s = pets_start_s + tick_s * i;
            const Timestamp now = timestamp_from_s(now_s);
            for (; next < all.size() && all[next].arrival <= now; ++next)
                engine_.submit(all[next].measurement, all[next].arrival);
            const auto poses = engine_.step(now);
            if (i % 5 == 0) locate(poses, now_s);
            if (frame < images_.size() && now_s >= pets_time_s(frame) + image_late_s + 2 * tick_s) name(poses, frame++);
        }
        return outcome_;
    }

  private:
    void locate(std::span<const Pose> poses, double now_s) {
        for (const Pose& pose : poses) {
            const auto way = scene_.ways.find(static_cast<std::uint32_t>(number(pose.target)) - 100);
            if (way == scene_.ways.end()) continue;
            const auto truth_m = way->second.at(now_s);
            if (!truth_m.has_value() || now_s < way->second.first_s() + warm_s) continue;
            if (pose.estimate.missing != Missing::nothing) {
                ++outcome_.errors.none;
                continue;
            }
            const Eigen::Vector2d place_m(pose.estimate.position_site_m[0], pose.estimate.position_site_m[1]);
            const double error_m = (place_m - truth_m.value()).norm();
            outcome_.errors.all_m.push_back(error_m);
            outcome_.errors.covered += error_m <= double{pose.horizontal_error_95_m};
        }
    }

    void name(std::span<const Pose> poses, std::size_t frame) {
        std::map<std::uint32_t, std::uint32_t> person_by_name; // of a track, by the engine
        for (const Pose& pose : poses)
            if (pose.seen_as.camera != no_address)
                person_by_name[pose.seen_as.track] = static_cast<std::uint32_t>(number(pose.target)) - 100;
        const double time_s = pets_time_s(frame);
        for (const auto& [track, person] : images_[frame].person_of) {
            const double track_first_s = track_first_s_.try_emplace(track, time_s).first->second;
            if (time_s < scene_.ways.at(person).first_s() + warm_s) continue;
            const auto named = person_by_name.find(track);
            const bool is_named = named != person_by_name.end();
            note(outcome_.names, is_named, is_named && named->second == person, track, time_s, wrong_since_s_);
            if (time_s >= track_first_s + warm_s)
                note(outcome_.settled, is_named, is_named && named->second == person, track, time_s, settled_since_s_);
        }
    }

    static void note(Names& names, bool is_named, bool is_right, std::uint32_t track, double time_s,
                     std::map<std::uint32_t, double>& since_s) {
        ++names.frames;
        names.right += is_right;
        names.wrong += is_named && !is_right;
        if (!is_named || is_right) {
            since_s.erase(track);
            return;
        }
        const double began_s = since_s.try_emplace(track, time_s).first->second;
        names.longest_wrong_s = std::max(names.longest_wrong_s, time_s - began_s + pets_frame_s);
    }

    const PetsScene& scene_;
    const std::vector<PetsImage>& images_;
    Engine engine_;
    PetsOutcome outcome_;
    std::map<std::uint32_t, double> track_first_s_, wrong_since_s_, settled_since_s_;
};

EngineSettings engine_with(const PetsScene& scene, const EstimatorSettings& estimator, std::size_t cameras) {
    EngineSettings settings;
    settings.fusion.estimator = estimator.row->name;
    settings.fusion.rate_hz = 1 / tick_s;
    settings.site = scene.site;
    settings.cameras = cameras;
    settings.estimators.push_back(estimator);
    return settings;
}

template <class Settings>
EstimatorSettings in_the_plane(const char* name) {
    auto settings = std::make_shared<Settings>();
    settings->planar = true;
    settings->height_m = pets_tag_m;
    return {find_estimator(name), settings};
}

Errors of_foot_points(const PetsScene& scene, const std::vector<PetsImage>& images) {
    Errors errors;
    for (std::size_t frame = 0; frame < images.size(); ++frame)
        for (const Measurement& m : images[frame].feet) {
            const auto* foot = std::get_if<FootPoint>(&m.observation);
            const auto person = images[frame].person_of.find(foot->track);
            if (person == images[frame].person_of.end()) continue;
            const auto truth_m = scene.ways.at(person->second).at(pets_time_s(frame));
            if (!truth_m.has_value()) continue;
            const Eigen::Vector2d off(foot->position_site_m[0] - truth_m.value().x(),
                                      foot->position_site_m[1] - truth_m.value().y());
            const auto [xx, xy, yy] = foot->covariance_m2;
            errors.all_m.push_back(off.norm());
            errors.covered += off.dot(Eigen::Matrix2d{{xx, xy}, {xy, yy}}.inverse() * off) < 5.991;
        }
    return errors;
}

void print_names(const char* name, const PetsOutcome& outcome) {
    for (const auto& [who, names] : {std::pair("people", outcome.names), std::pair("tracks too", outcome.settled)})
        std::printf("%s, %s there for 2 s: %zu person-frames, right %.2f %%, wrong %.2f %%, longest wrong %.2f s\n",
                    name, who, names.frames, 100 * names.right_share(), 100 * names.wrong_share(),
                    names.longest_wrong_s);
}

struct PetsTable {
    PetsOutcome fixes, federated_heard, ours_heard, federated, ours;
};

PetsTable pets_table(const PetsScene& scene, const std::vector<PetsImage>& images, bool with_body) {
    const auto fixes = in_the_plane<ChanTaylorSettings>("chan_taylor");
    const auto federated = in_the_plane<FederatedSettings>("federated");
    const auto inertial = in_the_plane<InertialEkfSettings>("inertial_ekf");
    PetsTable table;
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const PetsRanges ranges = pets_ranges(scene, seed, with_body);
        const auto with = [&](const EstimatorSettings& estimator, bool sees) {
            return PetsRun(scene, images, engine_with(scene, estimator, sees)).run(as_they_come(ranges, images, sees));
        };
        table.fixes.add(with(fixes, false));
        table.federated_heard.add(with(federated, false));
        table.ours_heard.add(with(inertial, false));
        table.federated.add(with(federated, true));
        table.ours.add(with(inertial, true));
        std::printf("seed %u: %zu people, %zu ranges, %.1f %% of them blocked by posts\n", seed, scene.ways.size(),
                    ranges.all.size(), 100. * ranges.blocked / static_cast<double>(ranges.all.size()));
    }
    return table;
}

void print_table(PetsTable& table, Errors feet) {
    std::puts("| | mean m | 80 % | largest | within the 95 % bound | without a pose |");
    feet.print("foot points of the tracker, when there are any");
    table.fixes.errors.print("chan_taylor, UWB alone");
    table.federated_heard.errors.print("federated, UWB alone");
    table.ours_heard.errors.print("inertial_ekf, UWB alone");
    table.federated.errors.print("federated");
    table.ours.errors.print("inertial_ekf");
    print_names("federated", table.federated);
    print_names("inertial_ekf", table.ours);
}

double better(const PetsOutcome& fused, const PetsOutcome& alone) {
    return 1 - fused.errors.mean_m() / alone.errors.mean_m();
}

/// Ranges as they are, and with the wearers' bodies in their way.
std::array<PetsTable, 2> print_tables(const PetsScene& scene,
                                      const std::vector<std::vector<vision::Detection>>& detections) {
    const auto images = pets_images(scene, detections);
    std::array<PetsTable, 2> tables;
    for (const bool with_body : {false, true}) {
        std::printf("posts%s\n", with_body ? " and the wearers' bodies" : "");
        tables[with_body ? 1 : 0] = pets_table(scene, images, with_body);
        print_table(tables[with_body ? 1 : 0], of_foot_points(scene, images));
    }
    return tables;
}

// Issue 5 aims at 98 %, 1 s and 40 %: docs/cameras.md says what is met. What is asserted is what is reached.
TEST(PetsFusion, WhoIsWhoAndWhere) {
    const auto scene = pets_scene();
    if (!scene.has_value()) GTEST_SKIP() << "no pets2009 or mot15_sort_det in LOCUS_DATA or ../shared/data";
    for (const PetsTable& table : print_tables(scene.value(), public_detections(scene.value().people.size()))) {
        for (const PetsOutcome* fused : {&table.federated, &table.ours}) {
            EXPECT_GE(fused->settled.right_share(), 0.96);
            EXPECT_LE(fused->settled.wrong_share(), 0.025);
            EXPECT_EQ(fused->errors.none, 0u);
            EXPECT_GT(better(*fused, table.fixes), 0);
        }
        EXPECT_GE(better(table.ours, table.ours_heard), 0.15);
        EXPECT_GE(better(table.federated, table.federated_heard), 0.15);
        EXPECT_LE(table.ours.settled.longest_wrong_s, 2.5);
    }
}

TEST(PetsFusion, WithOurOwnDetections) {
    if (!std::getenv("LOCUS_ALL_FRAMES")) GTEST_SKIP() << "takes a minute: LOCUS_ALL_FRAMES=1 runs it";
    const auto scene = pets_scene();
    if (!scene.has_value()) GTEST_SKIP() << "no pets2009 or mot15_sort_det in LOCUS_DATA or ../shared/data";
    const auto found = own_detections("hog_motion", scene->people.size(), heights_in_video(scene->view));
    ASSERT_FALSE(found.empty());
    for (const PetsTable& table : print_tables(scene.value(), found)) {
        EXPECT_GE(table.ours.settled.right_share(), 0.96);
        EXPECT_GE(better(table.ours, table.ours_heard), 0.15);
    }
}

PetsOutcome names_by(const PetsScene& scene, const std::vector<PetsImage>& images, const VisionSettings& vision) {
    PetsOutcome outcome;
    for (unsigned seed = 1; seed <= 3; ++seed) {
        EngineSettings settings = engine_with(scene, in_the_plane<InertialEkfSettings>("inertial_ekf"), 1);
        settings.vision = vision;
        outcome.add(PetsRun(scene, images, settings).run(as_they_come(pets_ranges(scene, seed, false), images, true)));
    }
    std::printf("%s, looks_weight %.0f, near_m %.0f, %.0f s: mean error %.3f m\n", vision.association.c_str(),
                vision.looks_weight, vision.near_m, vision.trajectory_time_s, outcome.errors.mean_m());
    print_names("inertial_ekf", outcome);
    return outcome;
}

/// The same names by all ways that there are, with the looks that our own detections have.
TEST(PetsFusion, NamesByAssociation) {
    if (!std::getenv("LOCUS_ALL_FRAMES")) GTEST_SKIP() << "takes a minute: LOCUS_ALL_FRAMES=1 runs it";
    const auto scene = pets_scene();
    if (!scene.has_value()) GTEST_SKIP() << "no pets2009 or mot15_sort_det in LOCUS_DATA or ../shared/data";
    const auto found = own_detections("hog_motion", scene->people.size(), heights_in_video(scene->view));
    ASSERT_FALSE(found.empty());
    const auto images = pets_images(scene.value(), found);
    VisionSettings plain, looks, matrix;
    looks.looks_weight = 3;
    matrix.association = "matrix";
    VisionSettings matrix_for_uwb = matrix;
    matrix_for_uwb.near_m = matrix_for_uwb.trajectory_time_s = matrix_for_uwb.looks_time_s = 1;
    const double without = names_by(scene.value(), images, plain).settled.right_share();
    EXPECT_GE(without, 0.96);
    EXPECT_GE(names_by(scene.value(), images, looks).settled.right_share(), without - 0.01);
    names_by(scene.value(), images, matrix);
    EXPECT_GE(names_by(scene.value(), images, matrix_for_uwb).settled.right_share(), 0.8);
}

} // namespace
} // namespace locus::test
