// Visual odometry on a walk through rooms that are drawn, with truth. LOCUS_ALL_FRAMES=1 walks three rounds in each of
// three rooms (some minutes); what is printed stands in docs/visual-odometry.md.
#include "drivers/camera/odometry/visual_odometer.h"
#include "tests/support/room/odometry_score.h"
#include "tests/support/room/room_film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

namespace locus::camera {
namespace {

const Eigen::Vector3d room_size_m(9, 7, 2.8);

VisualOdometer room_odometer() {
    return {{}, room::RoomScene::lens(), {room::RoomScene::width_px, room::RoomScene::height_px}};
}

struct Walked {
    std::vector<room::PathPair> path; ///< of the first segment
    std::size_t pictures = 0, told = 0;
    std::uint32_t segments = 0;
    std::clock_t clocks = 0;

    void add(const OdometerReading& reading, const room::RoomView& truth) {
        ++pictures;
        segments = std::max(segments, reading.segment);
        if (!reading.pose.has_value()) return;
        const CameraPose& pose = reading.pose.value();
        ++told;
        if (reading.segment != 1) return;
        path.push_back({truth.position_m, pose.centre(), truth.room_from_camera, pose.camera_from_map.conjugate()});
    }
};

Walked walk_room(unsigned seed, double duration_s, double rate_hz) {
    const room::RoomScene scene(seed, room_size_m);
    const room::RoomWalk walk;
    room::RoomFilm film(scene, walk, seed);
    VisualOdometer odometer = room_odometer();
    Walked walked;
    for (int i = 0; i < static_cast<int>(duration_s * rate_hz); ++i) {
        const Picture picture = film.at(i / rate_hz);
        const std::clock_t begun = std::clock();
        const OdometerReading reading = odometer.look(picture, timestamp_from_s(i / rate_hz));
        walked.clocks += std::clock() - begun;
        walked.add(reading, walk.at(i / rate_hz));
    }
    return walked;
}

room::OdometryScore tell(const char* what, const Walked& walked, double way_m) {
    const auto score = room::score_odometry(walked.path, way_m);
    std::printf(
        "%s: %.1f m, RMSE %.3f m (%.2f %% of the way), ways of %.0f m off by %.2f %%, %zu of %zu pictures told, "
        "%.0f pictures a second of processor time\n",
        what, score.length_m, score.rmse_m, 100 * score.rmse_m / score.length_m, way_m, 100 * score.relative,
        walked.told, walked.pictures,
        static_cast<double>(walked.pictures) * CLOCKS_PER_SEC / static_cast<double>(walked.clocks));
    return score;
}

TEST(VisualOdometer, FollowsAWalkRoundACorner) {
    const Walked walked = walk_room(1, 6, 15);
    const auto score = tell("a corner", walked, 5);
    EXPECT_EQ(walked.segments, 1U);
    EXPECT_GT(static_cast<double>(walked.told), 0.9 * static_cast<double>(walked.pictures));
    EXPECT_LT(score.rmse_m, 0.02 * score.length_m);
    EXPECT_LT(score.relative, 0.02);
}

TEST(VisualOdometer, DriftsLittleInThreeRounds) {
    if (!std::getenv("LOCUS_ALL_FRAMES")) GTEST_SKIP() << "takes minutes: LOCUS_ALL_FRAMES=1 runs it";
    const room::RoomWalk walk;
    double relative = 0;
    for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
        const Walked walked = walk_room(seed, 3 * walk.round_m() / walk.speed_mps(), 30);
        const auto score = tell(("room " + std::to_string(seed)).c_str(), walked, 10);
        EXPECT_EQ(walked.segments, 1U);
        EXPECT_LT(score.rmse_m, 0.02 * score.length_m);
        relative += score.relative / 5;
    }
    EXPECT_LT(relative, 0.02) << "in the mean; single rooms have been 2.7 %";
}

TEST(VisualOdometer, SaysThatItIsLostAndBeginsAnew) {
    const room::RoomScene scene(2, room_size_m);
    const room::RoomWalk walk;
    room::RoomFilm film(scene, walk, 2);
    VisualOdometer odometer = room_odometer();
    std::vector<OdometerReading> readings;
    for (int i = 0; i < 45; ++i) { // a hand before the lens from 1 s to 2 s
        const bool is_covered = i >= 15 && i < 30;
        readings.push_back(odometer.look(is_covered ? film.covered() : film.at(i / 15.), timestamp_from_s(i / 15.)));
    }
    EXPECT_EQ(readings[0].state, OdometerState::starting);
    EXPECT_EQ(readings[14].state, OdometerState::tracking);
    EXPECT_EQ(readings[14].segment, 1U);
    for (std::size_t i = 15; i < 30; ++i) EXPECT_FALSE(readings[i].pose.has_value()) << i;
    EXPECT_EQ(readings[17].state, OdometerState::tracking) << "one dark picture is no loss";
    EXPECT_EQ(readings[29].state, OdometerState::lost);
    EXPECT_EQ(readings[44].state, OdometerState::tracking);
    EXPECT_EQ(readings[44].segment, 2U);
    EXPECT_TRUE(readings[44].pose.has_value());
}

TEST(VisualOdometer, GoesOnAfterAShortGap) {
    const room::RoomScene scene(3, room_size_m);
    const room::RoomWalk walk;
    room::RoomFilm film(scene, walk, 3);
    VisualOdometer odometer = room_odometer();
    OdometerReading reading;
    for (int i = 0; i < 30; ++i) {
        const bool is_covered = i >= 20 && i < 25; // a third of a second
        reading = odometer.look(is_covered ? film.covered() : film.at(i / 15.), timestamp_from_s(i / 15.));
    }
    EXPECT_EQ(reading.state, OdometerState::tracking);
    EXPECT_EQ(reading.segment, 1U);
    EXPECT_TRUE(reading.pose.has_value());
}

TEST(VisualOdometer, DoesNotStartWithoutAWay) {
    const room::RoomScene scene(1, room_size_m);
    const room::RoomWalk walk;
    room::RoomFilm film(scene, walk, 1);
    VisualOdometer odometer = room_odometer();
    for (int i = 0; i < 8; ++i) {
        const auto reading = odometer.look(film.at(0), timestamp_from_s(i / 15.)); // stands, only the noise is new
        EXPECT_EQ(reading.state, OdometerState::starting);
        EXPECT_FALSE(reading.pose.has_value());
    }
}

TEST(VisualOdometer, SaysTheSameOfTheSamePictures) {
    const room::RoomScene scene(1, room_size_m);
    const room::RoomWalk walk;
    room::RoomFilm film(scene, walk, 1);
    VisualOdometer one = room_odometer(), other = room_odometer();
    for (int i = 0; i < 20; ++i) {
        const Picture picture = film.at(i / 15.);
        const auto a = one.look(picture, timestamp_from_s(i / 15.)), b = other.look(picture, timestamp_from_s(i / 15.));
        ASSERT_EQ(a.pose.has_value(), b.pose.has_value());
        if (!a.pose.has_value()) continue;
        EXPECT_EQ(a.pose.value().map_in_camera, b.pose.value().map_in_camera);
    }
}

} // namespace
} // namespace locus::camera
