// What a detector costs a frame: processor time on one core, a noisy scene with six people who walk. Frames a second of
// a core are items_per_second.
#include "drivers/camera/detector.h"
#include "drivers/camera/mat.h"

#include <benchmark/benchmark.h>
#include <opencv2/imgproc.hpp>

#include <vector>

namespace {

using namespace locus::camera;

/// People are a sixth of the picture high, as a camera under the ceiling of a hall sees them.
std::vector<Picture> walk(int width_px, int height_px) {
    constexpr int frames = 20;
    cv::RNG random{1};
    cv::Mat wall(height_px / 8, width_px / 8, CV_8UC3);
    random.fill(wall, cv::RNG::UNIFORM, 90, 170);
    cv::resize(wall, wall, {width_px, height_px});
    std::vector<Picture> pictures(frames);
    for (int i = 0; i < frames; ++i) {
        pictures[static_cast<std::size_t>(i)].resize(width_px, height_px, 3);
        cv::Mat image = as_mat(pictures[static_cast<std::size_t>(i)]);
        wall.copyTo(image);
        const auto person_px = static_cast<float>(height_px) / 6;
        for (int person = 0; person < 6; ++person) {
            const float x =
                static_cast<float>(width_px) * static_cast<float>(person + 1) / 7 + static_cast<float>(4 * i);
            const float y = static_cast<float>(height_px) * (0.4F + 0.08F * static_cast<float>(person));
            cv::ellipse(image, cv::RotatedRect({x, y}, {0.33F * person_px, person_px}, 0), {40, 30, 60}, cv::FILLED);
        }
        cv::Mat noise(image.size(), CV_16SC3);
        random.fill(noise, cv::RNG::NORMAL, 0, 2);
        cv::add(image, noise, image, cv::noArray(), CV_8UC3);
    }
    return pictures;
}

void detect(benchmark::State& state, const char* name) {
    const auto pictures = walk(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
    const DetectorRow* row = find_detector(name);
    const auto settings = row->options.make();
    std::string error;
    const auto detector = row->make(settings.get(), {}, error);
    std::size_t next = 0;
    for (auto _ : state) benchmark::DoNotOptimize(detector->detect(pictures[next++ % pictures.size()]));
    state.SetItemsProcessed(state.iterations());
}

BENCHMARK_CAPTURE(detect, motion, "motion")->Args({640, 360})->Args({1280, 720})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(detect, hog, "hog")->Args({640, 360})->Args({1280, 720})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(detect, hog_motion, "hog_motion")->Args({640, 360})->Args({1280, 720})->Unit(benchmark::kMillisecond);

} // namespace
