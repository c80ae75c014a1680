// A camera on the body, in the daemon: a folder of pictures of a walk through a drawn room is its device, a tag behind
// a pseudo-terminal is worn by the same person. Visual odometry and ranges together tell what its unit is in metres.
#include "tests/support/daemon_process.h"
#include "tests/support/room/room_film.h"
#include "tests/support/socket_client.h"
#include "tests/support/trek_tag.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <memory>

namespace locus {
namespace {

using test::SocketClient;

constexpr double film_rate_hz = 12, film_s = 14;
constexpr double wearer_noise_m = 0.05;
constexpr test::TrekTag::Anchors room_anchors_m{{{0, 0, 2.6}, {9, 0, 0.4}, {9, 7, 2.6}, {0, 7, 0.4}}};

class WornCameraDaemon : public ::testing::Test {
  protected:
    WornCameraDaemon() {
        std::filesystem::create_directory(folder_ / "film");
        const room::RoomScene scene(1, {9, 7, 2.8});
        room::RoomFilm film(scene, walk_, 1);
        for (int i = 0; i < static_cast<int>(film_s * film_rate_hz); ++i) write(film.at(i / film_rate_hz), i);
        constexpr double f = room::RoomScene::focal_px;
        constexpr int width = room::RoomScene::width_px, height = room::RoomScene::height_px;
        test::write_all(folder_ / "body.yaml",
                        fmt::format("model: pinhole\nwidth_px: {}\nheight_px: {}\nfx_px: {}\nfy_px: {}\ncx_px: "
                                    "{}\ncy_px: {}\nrotation_vector_rad: [0, 0, 0]\ntranslation_m: [0, 0, 0]\n",
                                    width, height, f, f, room::RoomScene::lens().centre_px.x(),
                                    room::RoomScene::lens().centre_px.y()));
        test::write_all(folder_ / "locusd.yaml", fmt::format(R"(site:
  name: room
  anchors:
{}inputs:
  - {{name: tag, transport: pty, path: {folder}/tag, decoder: trek1000, tag_offset: 16}}
cameras:
  - {{name: body, source: recorded, path: {folder}/film, rate_hz: {rate}, worn_by: 16, calibration: {folder}/body.yaml}}
targets: [{{name: walker, address: 16, estimator: visual_scale}}]
estimators: {{visual_scale: {{known_below: 0.1}}}}
publish: {{socket: {folder}/locusd.sock}}
)",
                                                             tag_.anchors_yaml(), fmt::arg("folder", folder_.path()),
                                                             fmt::arg("rate", film_rate_hz)));
        daemon_ = std::make_unique<test::DaemonProcess>(std::vector<std::string>{"--config", folder_ / "locusd.yaml"},
                                                        folder_ / "log");
    }

    void write(const camera::Picture& picture, int number) const {
        std::ofstream file(folder_ / fmt::format("film/{:04}.pgm", number), std::ios::binary);
        file << fmt::format("P5 {} {} 255\n", picture.width_px, picture.height_px);
        file.write(reinterpret_cast<const char*>(picture.pixels.data()),
                   static_cast<std::streamsize>(picture.pixels.size()));
    }

    /// When the film began, by what the daemon says of its camera.
    void synchronise(SocketClient& client) {
        ASSERT_TRUE(test::eventually([&] {
            const auto inputs = client.ask("?SOURCES;", "SOURCES")["inputs"];
            if (inputs.size() != 2 || inputs[1].value("packets", 0) < 1) return false;
            const double taken = inputs[1]["packets"].get<double>() + inputs[1]["kernel_dropped"].get<double>() - 1;
            first_picture_ = std::chrono::steady_clock::now() -
                             std::chrono::duration<double>(inputs[1]["age_s"].get<double>() + taken / film_rate_hz);
            return true;
        })) << test::read_all(folder_ / "log");
    }
    double now_s() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - first_picture_).count();
    }

    test::TrekTag tag_{room_anchors_m, wearer_noise_m};
    const room::RoomWalk walk_;
    test::TemporaryFolder folder_;
    test::FakeDevice device_{folder_ / "tag"};
    std::unique_ptr<test::DaemonProcess> daemon_;
    std::chrono::time_point<std::chrono::steady_clock, std::chrono::duration<double>> first_picture_;
};

TEST_F(WornCameraDaemon, FindsTheScaleOfItsOwnOdometryAndUsesIt) {
    SocketClient client{folder_ / "locusd.sock"};
    ASSERT_TRUE(client.connected()) << test::read_all(folder_ / "log");
    synchronise(client);
    nlohmann::json told;
    double sum_m = 0, reached_s = 0;
    int poses = 0;
    while (now_s() < film_s - 0.5) {
        device_.send(encode(tag_.report_at(walk_.at(now_s()).position_m)));
        std::this_thread::sleep_for(std::chrono::milliseconds{50});
        const auto polled = client.poll();
        if (polled.empty() || !polled.front().contains("odometry_scale")) continue;
        const auto& pose = polled.front();
        if (!pose["odometry_scale"].contains("metres_per_unit")) continue;
        if (told.is_null()) reached_s = now_s();
        told = pose;
        const auto& p = pose["position_site_m"];
        const Eigen::Vector2d here_m(p[0].get<double>(), p[1].get<double>());
        sum_m += (here_m - walk_.at(now_s()).position_m.head<2>()).norm();
        ++poses;
    }
    ASSERT_GT(poses, 0) << client.ask("?SOURCES;", "SOURCES") << '\n' << test::read_all(folder_ / "log");
    std::printf("scale known after %.1f s, then off by %.3f m in the mean of %d poses: %s\n", reached_s, sum_m / poses,
                poses, told["odometry_scale"].dump().c_str());
    EXPECT_LT(told["odometry_scale"]["relative_sigma"].get<double>(), 0.1);
    EXPECT_LT(sum_m / poses, 0.3);
    const auto kinds = told["kinds_used"].get<std::vector<std::string>>();
    EXPECT_NE(std::ranges::find(kinds, "VISUAL_ODOMETRY"), kinds.end());
    const auto camera = client.ask("?SOURCES;", "SOURCES")["inputs"][1];
    EXPECT_EQ(camera["name"], "body");
    EXPECT_GT(camera["measurements"].get<int>(), 60);
}

} // namespace
} // namespace locus
