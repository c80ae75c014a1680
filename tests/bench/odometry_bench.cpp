// What visual odometry costs a picture: processor time on one core, a second's walk through a drawn room after its
// start. Pictures a second of a core are items_per_second. Beside it, in the same run, what nobody can do without:
// OpenCV's ORB alone with as many features, and with it a brute-force match against the picture before.
#include "drivers/camera/odometry/visual_odometer.h"
#include "tests/support/room/room_film.h"

#include <benchmark/benchmark.h>
#include <opencv2/features2d.hpp>

#include <algorithm>
#include <vector>

namespace {

using namespace locus;

constexpr int pictures = 240;
constexpr double picture_rate_hz = 30;

/// Eight seconds: a straight way and a corner, twice.
const std::vector<camera::Picture>& walk_film() {
    static const std::vector<camera::Picture> film = [] {
        const room::RoomScene scene(1, {9, 7, 2.8});
        const room::RoomWalk walk;
        room::RoomFilm camera(scene, walk, 1);
        std::vector<camera::Picture> all;
        for (int i = 0; i < pictures; ++i) all.push_back(camera.at(i / picture_rate_hz));
        return all;
    }();
    return film;
}

cv::Mat grey(const camera::Picture& picture) {
    cv::Mat image(picture.height_px, picture.width_px, CV_8U);
    std::copy(picture.pixels.begin(), picture.pixels.end(), image.data);
    return image;
}

void visual_odometry(benchmark::State& state) {
    const auto& film = walk_film();
    camera::OdometerSettings settings;
    settings.features = static_cast<std::uint32_t>(state.range(0));
    for (auto _ : state) {
        camera::VisualOdometer odometer(settings, room::RoomScene::lens(),
                                        {room::RoomScene::width_px, room::RoomScene::height_px});
        for (int i = 0; i < pictures; ++i)
            benchmark::DoNotOptimize(
                odometer.look(film[static_cast<std::size_t>(i)], timestamp_from_s(i / picture_rate_hz)));
    }
    state.SetItemsProcessed(state.iterations() * pictures);
}

void orb(benchmark::State& state, bool matches) {
    const auto& film = walk_film();
    cv::setNumThreads(1);
    const auto finder = cv::ORB::create(static_cast<int>(state.range(0)));
    const cv::BFMatcher matcher(cv::NORM_HAMMING);
    for (auto _ : state) {
        cv::Mat before;
        for (const camera::Picture& picture : film) {
            std::vector<cv::KeyPoint> points;
            cv::Mat descriptors;
            finder->detectAndCompute(grey(picture), cv::noArray(), points, descriptors);
            std::vector<cv::DMatch> found;
            if (matches && !before.empty()) matcher.match(before, descriptors, found);
            before = descriptors;
            benchmark::DoNotOptimize(found.data());
        }
    }
    state.SetItemsProcessed(state.iterations() * pictures);
}

BENCHMARK(visual_odometry)->Arg(1000)->Arg(1500)->Unit(benchmark::kMillisecond)->Iterations(1)->Repetitions(3);
BENCHMARK_CAPTURE(orb, alone, false)->Arg(1000)->Unit(benchmark::kMillisecond)->Iterations(1)->Repetitions(3);
BENCHMARK_CAPTURE(orb, and_match, true)->Arg(1000)->Unit(benchmark::kMillisecond)->Iterations(1)->Repetitions(3);

} // namespace
