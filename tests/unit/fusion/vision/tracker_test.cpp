// The tracker on made-up boxes: birth, names, occlusions, looks, weak detections, and input that is none.
#include "fusion/vision/tracker.h"
#include "tests/unit/fusion/vision/cameras.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

namespace locus::vision {
namespace {

using Image = std::vector<Detection>;

Detection person(double middle_px, double bottom_px, float score = 0.9F, Appearance looks = {}) {
    return {
        {static_cast<float>(middle_px - 20), static_cast<float>(bottom_px - 100), 40, 100}, score, std::move(looks)};
}

/// Ten images a second.
class Film {
  public:
    explicit Film(const TrackerSettings& settings = {}, std::optional<FloorView> floor = std::nullopt)
        : tracker_(settings, std::move(floor)) {}

    std::vector<ImageTrack> see(const Image& image) {
        time_ += std::chrono::milliseconds(100);
        const auto tracks = tracker_.update(time_, image);
        return {tracks.begin(), tracks.end()};
    }
    std::vector<ImageTrack> see(int images, const Image& image) {
        std::vector<ImageTrack> last;
        for (int i = 0; i < images; ++i) last = see(image);
        return last;
    }
    Tracker& tracker() { return tracker_; }
    Timestamp time() const { return time_; }

  private:
    Tracker tracker_;
    Timestamp time_ = timestamp_from_s(1);
};

TEST(Tracker, ThreeDetectionsMakeAPerson) {
    Film film;
    EXPECT_TRUE(film.see({person(100, 300)}).empty());
    EXPECT_TRUE(film.see({person(102, 300)}).empty());
    const auto tracks = film.see({person(104, 300)});
    ASSERT_EQ(tracks.size(), 1u);
    EXPECT_EQ(tracks[0].id, 1u);
    EXPECT_NEAR(tracks[0].foot_px.x(), 103, 2);
    EXPECT_NEAR(tracks[0].foot_px.y(), 300, 1);
    EXPECT_NEAR(tracks[0].head_px.y(), 200, 1);
    EXPECT_NEAR(tracks[0].age_s, 0.2, 1e-9);
    EXPECT_GT(tracks[0].foot_covariance_px2(0, 0), 0);
}

TEST(Tracker, OneFalseAlarmIsForgotten) {
    Film film;
    film.see({person(100, 300)});
    film.see({});
    film.see({person(100, 300)});
    EXPECT_TRUE(film.see({person(100, 300)}).empty()) << "it counts anew";
    EXPECT_EQ(film.see({person(100, 300)}).size(), 1u);
}

TEST(Tracker, TwoWhoCrossKeepTheirNames) {
    // Side by side through the image towards each other, one 40 px in front; while they overlap by much, only the one
    // in front is detected. Errors of 3 px. 20 seeds: every one of them must keep the names.
    for (unsigned seed = 0; seed < 20; ++seed) {
        std::mt19937 random(seed);
        std::normal_distribution<double> error(0, 3);
        Film film;
        std::vector<ImageTrack> first, last;
        for (int i = 0; i < 100; ++i) {
            const double front = 100 + 8 * i, behind = 900 - 8 * i;
            Image image{person(front + error(random), 340 + error(random))};
            if (std::abs(front - behind) > 30) image.push_back(person(behind + error(random), 300 + error(random)));
            last = film.see(image);
            if (i == 10) first = last;
        }
        ASSERT_EQ(first.size(), 2u);
        ASSERT_EQ(last.size(), 2u) << "seed " << seed;
        EXPECT_EQ(first[0].id, last[0].id);
        EXPECT_EQ(first[1].id, last[1].id);
        const bool was_left = first[0].foot_px.x() < first[1].foot_px.x();
        EXPECT_EQ(last[0].foot_px.x() > last[1].foot_px.x(), was_left) << "names swapped, seed " << seed;
    }
}

TEST(Tracker, WhoIsCoveredIsShownAndFoundAgain) {
    Film film;
    film.see(5, {person(100, 300), person(200, 310)});
    std::vector<ImageTrack> tracks;
    for (int i = 0; i < 10; ++i) tracks = film.see({person(100 + 8 * i, 300), person(200, 310)});
    const auto id = tracks[0].id;
    for (int i = 10; i < 15; ++i) tracks = film.see({person(200, 310)}); // behind the one who stands in front
    ASSERT_EQ(tracks.size(), 2u) << "unseen for 0.5 s, but covered";
    EXPECT_TRUE(tracks[0].occluded);
    EXPECT_FALSE(tracks[1].occluded) << "who stands in front is not";
    EXPECT_NEAR(tracks[0].unseen_s, 0.5, 1e-9);
    EXPECT_NEAR(tracks[0].foot_px.x(), 100 + 8 * 14, 12);
    for (int i = 15; i < 30; ++i) tracks = film.see({person(100 + 8 * i, 300), person(200, 310)});
    ASSERT_EQ(tracks.size(), 2u);
    EXPECT_EQ(tracks[0].id, id);
    EXPECT_FALSE(tracks[0].occluded);
}

TEST(Tracker, BehindAPillarHeIsNotShownButFoundAgainWithinTheTime) {
    for (const bool in_time : {true, false}) {
        TrackerSettings settings;
        settings.lost_s = in_time ? 3 : 1;
        Film film(settings);
        for (int i = 0; i < 20; ++i) film.see({person(100 + 5 * i, 300)});
        std::vector<ImageTrack> tracks = film.see(15, {});
        EXPECT_TRUE(tracks.empty()) << "nobody explains why he is not seen";
        for (int i = 35; i < 40; ++i) tracks = film.see({person(100 + 5 * i, 300)});
        ASSERT_EQ(tracks.size(), 1u);
        EXPECT_EQ(tracks[0].id == 1, in_time);
    }
}

TEST(Tracker, LooksTellTwoApartWhoStoppedInFrontOfEachOther) {
    // Both vanish behind one another and come out on the sides that motion does not expect.
    const Appearance red{1, 0}, blue{0, 1};
    Film film;
    for (int i = 0; i < 20; ++i) film.see({person(100 + 5 * i, 300, 0.9F, red), person(300 - 5 * i, 300, 0.9F, blue)});
    film.see(5, {});
    std::vector<ImageTrack> tracks;
    for (int i = 0; i < 4; ++i)
        tracks = film.see({person(185 - 5 * i, 300, 0.9F, red), person(215 + 5 * i, 300, 0.9F, blue)});
    ASSERT_EQ(tracks.size(), 2u);
    EXPECT_EQ(tracks[0].id, 1u);
    EXPECT_LT(tracks[0].foot_px.x(), tracks[1].foot_px.x()) << "red is still the first";
}

TEST(Tracker, WeakDetectionsProlongAndDoNotBegin) {
    Film film;
    EXPECT_TRUE(film.see(10, {person(100, 300, 0.4F)}).empty());
    film.see(3, {person(500, 300)});
    const auto tracks = film.see(10, {person(500, 300, 0.4F)});
    ASSERT_EQ(tracks.size(), 1u);
    EXPECT_EQ(tracks[0].unseen_s, 0);
    EXPECT_EQ(tracks[0].score, 0.4F);
}

TEST(Tracker, NobodyIsFoundWhereHeCouldNotHaveWalked) {
    // Far away a few pixels are many metres: 30 m from a camera 4 m high, 0.1 rad down, somebody 12 px nearer to the
    // horizon.
    const Camera camera = vision_test::looking_down(vision_test::plain_pinhole(), 4, 0.1);
    const Eigen::Vector2d here_px = *pixel_of_floor(camera, {0, 30}), there_px = *pixel_of_floor(camera, {0, 60});
    const auto small = [](const Eigen::Vector2d& foot_px) {
        return Detection{
            {static_cast<float>(foot_px.x() - 10), static_cast<float>(foot_px.y() - 45), 20, 45}, 0.9F, {}};
    };
    for (const bool has_floor : {false, true}) {
        TrackerSettings settings;
        settings.gate = 100; // motion alone would take him
        Film film(settings, has_floor ? std::optional<FloorView>(camera) : std::nullopt);
        film.see(5, {small(here_px)});
        film.see(10, {});
        const auto tracks = film.see(4, {small(there_px)}); // 30 m in 1.1 s
        ASSERT_EQ(tracks.size(), 1u);
        EXPECT_EQ(tracks[0].id == 1, !has_floor);
    }
}

TEST(Tracker, FeetThatAreHiddenAreTakenFromTheHead) {
    const Camera camera = vision_test::looking_down(vision_test::plain_pinhole(), 4, 0.3);
    const Eigen::Vector3d foot_m(0, 10, 0), head_m(0, 10, 1.7);
    ImageTrack track;
    track.foot_px = look_at(camera, foot_m)->pixel_px;
    track.head_px = look_at(camera, head_m)->pixel_px;
    track.foot_covariance_px2 = track.head_covariance_px2 = Eigen::Matrix2d::Identity();
    const auto by_feet = stands_at(camera, track, {1.7, 0.1});
    track.foot_px.y() -= 60; // they are not seen: wrong by much, and known to be unsure
    track.foot_covariance_px2 *= 3600;
    const auto by_head = stands_at(camera, track, {1.7, 0.1});
    ASSERT_TRUE(by_feet && by_head);
    EXPECT_LT((by_head->position_site_m - Eigen::Vector2d(0, 10)).norm(), 1e-6);
    EXPECT_GT(by_head->covariance_m2.trace(), by_feet->covariance_m2.trace());
}

TEST(Tracker, BoxesThatAreNoneAndTimeThatStandsStillChangeNothing) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    Film film;
    film.see(3, {person(100, 300)});
    const Image bad{{{nan, 1, 2, 3}, 1, {}}, {{1, inf, 2, 3}, 1, {}},  {{1, 2, 0, 3}, 1, {}},
                    {{1, 2, 3, -4}, 1, {}},  {{1, 2, 3e8F, 4}, 1, {}}, {{100, 200, 40, 100}, nan, {}}};
    const auto tracks = film.see(5, bad);
    EXPECT_TRUE(tracks.empty()) << "unseen for 0.5 s";
    EXPECT_EQ(film.see({person(100, 300)}).size(), 1u);
    const auto again = film.tracker().update(film.time(), std::vector<Detection>{person(300, 300)});
    EXPECT_EQ(again.size(), 1u);
    const std::vector<Detection> crowd(5000, person(700, 300));
    EXPECT_LE(film.see(3, crowd).size(), max_detections + 1);
}

TEST(Tracker, SameBoxesSameTracks) {
    const auto run = [] {
        std::mt19937 random(5);
        std::uniform_real_distribution<double> anywhere(50, 600);
        Film film;
        std::vector<ImageTrack> last;
        for (int i = 0; i < 60; ++i) {
            Image image;
            for (int k = 0; k < 8; ++k) image.push_back(person(80 * k + 3 * i + 0.02 * anywhere(random), 200 + 30 * k));
            last = film.see(image);
        }
        return last;
    };
    const auto one = run(), other = run();
    ASSERT_EQ(one.size(), other.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_EQ(one[i].id, other[i].id);
        EXPECT_EQ(one[i].foot_px, other[i].foot_px);
    }
    EXPECT_EQ(one.size(), 8u);
}

} // namespace
} // namespace locus::vision
