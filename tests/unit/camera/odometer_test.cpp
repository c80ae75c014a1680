// Visual odometry on a walk through rooms that are drawn, with truth. LOCUS_ALL_FRAMES=1 walks three rounds in each of
// three rooms (some minutes).
#include "drivers/camera/odometry/visual_odometer.h"
#include "tests/support/room/odometry_score.h"
#include "tests/support/room/room_film.h"

#include <cstdio>
#include <cstdlib>
#include <ctime>

#include <gtest/gtest.h>

namespace locus::camera {
namespace {

const Eigen::Vector3d room_size_m(9, 7, 2.8);

struct Walked {
    std::vector<room::PathPair> path; ///< of the first segment
    std::size_t pictures = 0, told = 0;
    std::uint32_t segments = 0;
    double frames_a_second = 0;
};

room::PathPair pair_of(const room::RoomView& truth, const CameraPose& told) {
    return {truth.position_m, told.centre(), truth.room_from_camera, told.camera_from_map.conjugate()};
}

Walked walk_room(unsigned seed, double duration_s, const room::FilmSettings& film_settings = {}) {
    const room::RoomScene scene(seed, room_size_m);
    const room::RoomWalk walk;
    room::RoomFilm film(scene, walk, seed, film_settings);
    VisualOdometer odometer({}, room::RoomScene::lens(), {room::RoomScene::width_px, room::RoomScene::height_px});
    Walked walked;
    std::clock_t clocks = 0;
    const auto pictures = static_cast<std::size_t>(duration_s * film_settings.rate_hz);
    for (std::size_t i = 0; i < pictures; ++i) {
        const double time_s = static_cast<double>(i) / film_settings.rate_hz;
        const Picture picture = film.at(time_s);
        const std::clock_t begun = std::clock();
        const OdometerReading reading = odometer.look(picture, timestamp_from_s(time_s));
        clocks += std::clock() - begun;
        if (std::getenv("LOCUS_TELL"))
            std::printf("%.2f state %d segment %u points %zu\n", time_s, static_cast<int>(reading.state),
                        reading.segment, reading.points);
        walked.segments = std::max(walked.segments, reading.segment);
        ++walked.pictures;
        if (!reading.pose.has_value()) continue;
        ++walked.told;
        if (reading.segment == 1) walked.path.push_back(pair_of(walk.at(time_s), reading.pose.value()));
    }
    walked.frames_a_second = static_cast<double>(pictures) * CLOCKS_PER_SEC / static_cast<double>(clocks);
    return walked;
}

void tell(const char* what, unsigned seed, const Walked& walked, const room::OdometryScore& score, double way_m) {
    std::printf("%s, room %u: %.1f m, RMSE %.3f m (%.2f %%), of ways of %.0f m %.2f %%, told %zu of %zu, segments %u, "
                "%.1f pictures/s\n",
                what, seed, score.length_m, score.rmse_m, 100 * score.rmse_m / score.length_m, way_m,
                100 * score.relative, walked.told, walked.pictures, walked.segments, walked.frames_a_second);
}

TEST(VisualOdometer, FollowsAWalk) {
    const Walked walked = walk_room(1, std::getenv("LOCUS_WALK_S") ? std::atof(std::getenv("LOCUS_WALK_S")) : 10);
    const auto score = room::score_odometry(walked.path, 5);
    tell("walk", 1, walked, score, 5);
    EXPECT_EQ(walked.segments, 1U);
    EXPECT_GT(static_cast<double>(walked.told), 0.9 * static_cast<double>(walked.pictures));
    EXPECT_LT(score.rmse_m, 0.02 * score.length_m);
    EXPECT_LT(score.relative, 0.02);
}

TEST(VisualOdometer, DriftsLittleInThreeRounds) {
    if (!std::getenv("LOCUS_ALL_FRAMES")) GTEST_SKIP() << "takes minutes: LOCUS_ALL_FRAMES=1 runs it";
    for (const unsigned seed : {1U, 2U, 3U}) {
        const room::RoomWalk walk;
        const Walked walked = walk_room(seed, 3 * walk.round_m() / walk.speed_mps());
        const auto score = room::score_odometry(walked.path, 10);
        tell("three rounds", seed, walked, score, 10);
        EXPECT_EQ(walked.segments, 1U);
        EXPECT_LT(score.rmse_m, 0.02 * score.length_m);
        EXPECT_LT(score.relative, 0.02);
    }
}

} // namespace
} // namespace locus::camera
