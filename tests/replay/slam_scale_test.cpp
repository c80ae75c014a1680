// The scale of a real monocular SLAM (evo_trajectories: key frames of ORB-SLAM and motion capture) found on line from
// ranges that are simulated from the captured truth. On fr2_desk the capture has many gaps, one of 12 s. Where it has
// one nobody knows where the camera was; a straight line across it is not the truth, and the SLAM says so: without the
// gaps the key frames lie within 1 cm of the truth and their scale is 2.228, with lines across them within 10 cm and it
// is 2.185, which is the figure asked for. So both are run: ranges that are silent in gaps, and ranges along those
// lines.
#include "fusion/estimators/inertial_ekf.h"
#include "fusion/estimators/visual_scale.h"
#include "tests/replay/slam_paths.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace locus::slam {
namespace {

constexpr double with_lines = 1e9, without_gaps = 0.1; ///< longest gap of the capture that is bridged, s
constexpr unsigned seeds = 20;

struct Errors {
    double squares_m2 = 0, largest_step_m = 0;
    int count = 0, covered = 0;
    std::optional<Eigen::Vector3d> before_m;

    void add(const Estimate& estimate, const Eigen::Vector3d& truth_m) {
        if (estimate.missing != Missing::nothing) return;
        const Eigen::Vector3d here_m = vector(estimate.position_site_m), error_m = here_m - truth_m;
        const Eigen::Map<const Eigen::Matrix<double, 6, 6>> doubt(estimate.covariance.data());
        squares_m2 += error_m.squaredNorm();
        covered += error_m.dot(doubt.topLeftCorner<3, 3>().inverse() * error_m) <= 7.815; // chi-square of three, 95 %
        ++count;
        if (before_m.has_value()) largest_step_m = std::max(largest_step_m, (here_m - before_m.value()).norm());
        before_m = here_m;
    }
    /// What comes next is not the next moment.
    void pause() { before_m.reset(); }
    double rmse_m() const { return std::sqrt(squares_m2 / count); }
};

struct Told {
    Errors fused, uwb; ///< fifty times a second
    Errors fused_at_frames, uwb_at_frames;
    std::vector<double> scale_errors; ///< relative, of each seed at the end of the last segment
    double scale_sigma = 0;           ///< the last told
    int known = 0, unknown = 0,
        wrong = 0; ///< moments when a scale was told; when not; told and off by 4 sigma and more
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

class Ride {
  public:
    Ride(const Recording& recording, const Site& site, double longest_gap_s)
        : recording_(recording), gap_s_(longest_gap_s), fused_(site, {}), uwb_(site, {}) {}

    void go(const std::vector<Measurement>& all, double true_scale, Told& told) {
        auto next = all.begin();
        const int ticks = static_cast<int>(recording_.key_frames.back().time_s * 50);
        for (int i = 0; i <= ticks; ++i) {
            const double time_s = 0.02 * i;
            const Timestamp tick = timestamp_from_s(100 + time_s);
            for (; next != all.end() && next->time <= tick; ++next) take(*next, told);
            score(tick, at(recording_.truth, time_s, gap_s_), told.fused, told.uwb);
            note_scale(fused_.predict(tick).odometry_scale, true_scale, told);
        }
        told.fused.pause();
        told.uwb.pause();
        told.scale_errors.push_back(fused_.fit() ? std::abs(fused_.fit()->similarity.scale() / true_scale - 1) : 1);
        told.scale_sigma = fused_.fit() ? fused_.fit()->relative_scale_sigma() : 1;
    }

  private:
    void take(const Measurement& measurement, Told& told) {
        fused_.update(measurement);
        uwb_.update(measurement);
        if (!std::holds_alternative<VisualOdometry>(measurement.observation)) return;
        score(measurement.time, at(recording_.truth, to_s(measurement.time) - 100, gap_s_), told.fused_at_frames,
              told.uwb_at_frames);
    }
    void score(Timestamp time, const std::optional<Eigen::Vector3d>& truth_m, Errors& fused, Errors& uwb) const {
        if (!truth_m.has_value()) {
            fused.pause();
            uwb.pause();
            return;
        }
        fused.add(fused_.predict(time), truth_m.value());
        uwb.add(uwb_.predict(time), truth_m.value());
    }
    static void note_scale(const OdometryScale& scale, double true_scale, Told& told) {
        const bool known = std::isfinite(scale.metres_per_unit);
        ++(known ? told.known : told.unknown);
        const double off = known ? std::abs(scale.metres_per_unit / true_scale - 1) : 0;
        told.wrong += off > 4 * double{scale.relative_sigma} ? 1 : 0;
    }

    const Recording& recording_;
    double gap_s_;
    VisualScale fused_;
    InertialEkf uwb_;
};

Told run(const Recording& recording, double sigma_m, double longest_gap_s) {
    Told told;
    const Site site = room(recording.truth);
    const double true_scale = scale_to_truth(recording, -1, 1e9, longest_gap_s);
    for (unsigned seed = 1; seed <= seeds; ++seed)
        Ride(recording, site, longest_gap_s)
            .go(in_order(ranges(recording, site, sigma_m, seed, longest_gap_s), odometry(recording.key_frames)),
                true_scale, told);
    return told;
}

void print(const char* name, double sigma_m, const Told& t) {
    std::printf("| %s, %.2f m | %.2f / %.2f / %.2f | %.2f | %.3f -> %.3f | %.3f -> %.3f | %.3f | %.2f (%.2f) |\n", name,
                sigma_m, 100 * median(t.scale_errors), 100 * *std::ranges::max_element(t.scale_errors),
                100 * t.scale_sigma, static_cast<double>(t.known) / (t.known + t.unknown), t.uwb_at_frames.rmse_m(),
                t.fused_at_frames.rmse_m(), t.uwb.rmse_m(), t.fused.rmse_m(),
                static_cast<double>(t.fused.covered) / t.fused.count, t.fused.largest_step_m, t.uwb.largest_step_m);
}
void print_head() {
    std::puts(
        "| ranges | scale error at the end %: median / largest / told sigma | share of time known | RMSE 3D at key "
        "frames m, UWB -> fused | at 50 Hz | within 95 % | largest step in 20 ms (UWB's) |");
}

TEST(SlamScale, DeskWalk) {
    const auto desk = recording("fr2_desk_ORB_kf_mono.txt", "fr2_desk_groundtruth.txt");
    if (!desk) GTEST_SKIP() << "evo_trajectories is not there";
    EXPECT_NEAR(scale_to_truth(*desk, -1, 1e9, with_lines), 2.185, 0.001);
    print_head();
    for (const double sigma_m : {0.10, 0.30})
        for (const double gap_s : {without_gaps, with_lines}) {
            const Told told = run(*desk, sigma_m, gap_s);
            print(gap_s == with_lines ? "fr2_desk, lines across gaps" : "fr2_desk, silent in gaps", sigma_m, told);
            EXPECT_LE(median(told.scale_errors), sigma_m < 0.2 ? 0.005 : 0.01);
            EXPECT_LT(told.fused.rmse_m(), told.uwb.rmse_m());
            EXPECT_LT(told.fused_at_frames.rmse_m(), told.uwb_at_frames.rmse_m());
            EXPECT_EQ(gap_s == without_gaps ? told.wrong : 0, 0);
        }
}

/// The scale cannot be told from 0.1 m this way and that way, and is not.
TEST(SlamScale, TooSmallAMoveTellsNoScale) {
    const auto hands = recording("freiburg1_xyz-ORB_kf_mono.txt", "freiburg1_xyz-groundtruth.txt");
    if (!hands) GTEST_SKIP() << "evo_trajectories is not there";
    print_head();
    for (const double sigma_m : {0.10, 0.30}) {
        const Told told = run(*hands, sigma_m, with_lines);
        print("freiburg1_xyz", sigma_m, told);
        EXPECT_EQ(told.known, 0);
        EXPECT_GT(told.scale_sigma, 2 * VisualScaleSettings{}.known_below);
        EXPECT_LE(told.fused.rmse_m(), told.uwb.rmse_m());
        EXPECT_LE(told.fused.largest_step_m, 1.1 * told.uwb.largest_step_m);
    }
}

/// Loses its way twice for three seconds; what comes after has a segment, a rotation, an origin and a scale of its own.
struct Cut {
    std::vector<Measurement> odometry;
    double last_from_s = 0, last_stretch = 1;
};
Cut cut_twice(const Recording& recording, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    const double end_s = recording.key_frames.back().time_s;
    const std::array<double, 2> losses_s{0.4 * end_s, 0.7 * end_s};
    Cut cut;
    std::uint32_t segment = 0;
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    Eigen::Vector3d begin = Eigen::Vector3d::Zero();
    for (const Place& place : recording.key_frames) {
        const auto since = [&](double loss_s) { return place.time_s - loss_s; };
        if (std::ranges::any_of(losses_s, [&](double loss_s) { return since(loss_s) > 0 && since(loss_s) < 3; }))
            continue;
        const auto now =
            static_cast<std::uint32_t>(std::ranges::count_if(losses_s, [&](double s) { return since(s) > 0; }));
        if (now != segment) {
            segment = now;
            begin = place.position;
            turn = Eigen::Quaterniond(
                Eigen::Vector4d(normal(random), normal(random), normal(random), normal(random)).normalized());
            cut.last_stretch = std::exp(0.7 * normal(random));
            cut.last_from_s = place.time_s;
        }
        Place moved = place;
        moved.position = cut.last_stretch * (turn * (place.position - begin));
        moved.turn = turn * place.turn;
        cut.odometry.push_back(odometry({moved}).front());
        std::get<VisualOdometry>(cut.odometry.back().observation).segment = segment;
    }
    return cut;
}

TEST(SlamScale, LosesItsWayTwice) {
    const auto desk = recording("fr2_desk_ORB_kf_mono.txt", "fr2_desk_groundtruth.txt");
    if (!desk) GTEST_SKIP() << "evo_trajectories is not there";
    const Site site = room(desk->truth);
    print_head();
    for (const double sigma_m : {0.10, 0.30}) {
        Told told;
        for (unsigned seed = 1; seed <= seeds; ++seed) {
            const Cut cut = cut_twice(*desk, seed);
            const double true_scale = scale_to_truth(*desk, cut.last_from_s, 1e9, without_gaps) / cut.last_stretch;
            Ride(*desk, site, without_gaps)
                .go(in_order(ranges(*desk, site, sigma_m, seed, without_gaps), cut.odometry), true_scale, told);
        }
        print("fr2_desk, two losses", sigma_m, told);
        EXPECT_LE(median(told.scale_errors), sigma_m < 0.2 ? 0.02 : 0.06); // of the last 28 s alone
        EXPECT_LT(told.fused.rmse_m(), told.uwb.rmse_m());
        EXPECT_LE(told.fused.largest_step_m, 1.1 * told.uwb.largest_step_m);
    }
}

} // namespace
} // namespace locus::slam
