// A camera in the daemon: a folder of pictures is its device, a tag behind a pseudo-terminal is worn by whom it sees.
#include "fusion/vision/camera_model.h"
#include "tests/support/daemon_process.h"
#include "tests/support/socket_client.h"
#include "tests/support/trek_tag.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

namespace locus {
namespace {

using test::eventually;
using test::SocketClient;

constexpr int picture_width_px = 320, picture_height_px = 240;
constexpr double focal_px = 250, picture_rate_hz = 10;
constexpr int empty_pictures = 20, walk_pictures = 160, all_pictures = 600;

/// To and fro along a wall, 5 m wide; `picture` may lie between two.
Eigen::Vector2d walker_m(double picture) {
    const double angle = 2 * M_PI * (picture - empty_pictures) / walk_pictures;
    return {5 + 2.5 * std::sin(angle), 5 + 0.5 * std::cos(angle)};
}

/// Looks along y and 25 degrees down, from 3 m above the wall at y = -3.
vision::Camera hall_camera() {
    const double down = 25 * M_PI / 180;
    Eigen::Matrix3d camera_from_site;
    camera_from_site << 1, 0, 0, 0, -std::sin(down), -std::cos(down), 0, std::cos(down), -std::sin(down);
    const Eigen::Vector3d at_m(5, -3, 3);
    vision::PinholeLens lens;
    lens.focal_px = {focal_px, focal_px};
    lens.centre_px = {picture_width_px / 2., picture_height_px / 2.};
    return {lens, camera_from_site, -camera_from_site * at_m};
}

std::string calibration() {
    const vision::Camera camera = hall_camera();
    const Eigen::AngleAxisd turn(camera.camera_from_site);
    const Eigen::Vector3d r = turn.angle() * turn.axis(), t = camera.site_in_camera_m;
    return fmt::format("model: pinhole\nwidth_px: {}\nheight_px: {}\nfx_px: {}\nfy_px: {}\ncx_px: {}\ncy_px: {}\n"
                       "rotation_vector_rad: [{}, {}, {}]\ntranslation_m: [{}, {}, {}]\n",
                       picture_width_px, picture_height_px, focal_px, focal_px, picture_width_px / 2.,
                       picture_height_px / 2., r.x(), r.y(), r.z(), t.x(), t.y(), t.z());
}

class Canvas {
  public:
    /// A grey wall with the noise of a sensor.
    explicit Canvas(unsigned seed) : random_(seed) {
        for (char& pixel : pixels_) pixel = static_cast<char>(noise(170));
    }

    /// Somebody in dark clothes.
    void draw(const Eigen::Vector2d& at_m) {
        const auto foot = vision::look_at(hall_camera(), {at_m.x(), at_m.y(), 0});
        const auto head = vision::look_at(hall_camera(), {at_m.x(), at_m.y(), 1.7});
        const double height_px = foot->pixel_px.y() - head->pixel_px.y(), middle_px = foot->pixel_px.x();
        for (int y = int(head->pixel_px.y()); y <= int(foot->pixel_px.y()); ++y)
            for (int x = int(middle_px - 0.18 * height_px); x <= int(middle_px + 0.18 * height_px); ++x)
                pixels_[static_cast<std::size_t>(y * picture_width_px + x)] = static_cast<char>(noise(60));
    }

    void write(const std::string& path) const {
        std::ofstream(path, std::ios::binary)
            << fmt::format("P5 {} {} 255\n", picture_width_px, picture_height_px) << pixels_;
    }

  private:
    int noise(int grey) { return std::clamp(grey + int(std::lround(2 * normal_(random_))), 0, 255); }

    std::mt19937 random_;
    std::normal_distribution<double> normal_;
    std::string pixels_ = std::string(std::size_t{picture_width_px} * picture_height_px, '\0');
};

class CameraDaemon : public ::testing::Test {
  protected:
    CameraDaemon() {
        std::filesystem::create_directory(folder_ / "film");
        for (int i = 0; i < empty_pictures + walk_pictures; ++i) picture(i);
        for (int i = empty_pictures + walk_pictures; i < all_pictures; ++i)
            std::filesystem::create_symlink(path(i - walk_pictures), path(i));
        test::write_all(folder_ / "gate.yaml", calibration());
        device_ = std::make_unique<test::FakeDevice>(folder_ / "tag");
    }

    std::string path(int picture) const { return folder_ / fmt::format("film/{:04}.pgm", picture); }

    void picture(int i) {
        Canvas canvas(static_cast<unsigned>(i));
        if (i >= empty_pictures) canvas.draw(walker_m(i));
        canvas.write(path(i));
    }

    void start(const std::string& more = "") {
        test::write_all(folder_ / "locusd.yaml",
                        fmt::format(R"(site:
  name: hall
  anchors:
{3}inputs:
  - {{name: tag, transport: pty, path: {0}/tag, decoder: trek1000, tag_offset: 16}}
cameras:
  - {{name: gate, source: recorded, path: {0}/film, rate_hz: {1}, detector: motion, calibration: {0}/gate.yaml}}
targets:
  - {{name: walker, address: 16}}
fusion: {{rate_hz: 50, lost_after_s: 1}}
publish: {{socket: {0}/locusd.sock}}
{2})",
                                    folder_.path(), picture_rate_hz, more, tag_.anchors_yaml()));
        daemon_ = std::make_unique<test::DaemonProcess>(std::vector<std::string>{"--config", folder_ / "locusd.yaml"},
                                                        folder_ / "log");
    }

    /// The picture that is being taken, by what the daemon says of its camera.
    void synchronise(SocketClient& client) {
        ASSERT_TRUE(eventually([&] {
            const auto inputs = client.ask("?SOURCES;", "SOURCES")["inputs"];
            if (inputs.size() != 2 || inputs[1].value("packets", 0) < 1) return false;
            const double taken = inputs[1]["packets"].get<double>() + inputs[1]["kernel_dropped"].get<double>() - 1;
            first_picture_ = std::chrono::steady_clock::now() -
                             std::chrono::duration<double>(inputs[1]["age_s"].get<double>() + taken / picture_rate_hz);
            return true;
        })) << test::read_all(folder_ / "log");
    }
    Eigen::Vector2d walker_now_m() const {
        const std::chrono::duration<double> since = std::chrono::steady_clock::now() - first_picture_;
        return walker_m(since.count() * picture_rate_hz);
    }

    void report() {
        const Eigen::Vector2d at_m = walker_now_m();
        device_->send(encode(tag_.report_at({at_m.x(), at_m.y(), 1})));
    }

    /// Looks until a pose of `target` satisfies `good`; `worn`: the tag reports meanwhile.
    template <class Condition>
    testing::AssertionResult pose_comes(SocketClient& client, bool worn, Condition good) {
        nlohmann::json last;
        const bool came = eventually([&] {
            if (worn) report();
            std::this_thread::sleep_for(std::chrono::milliseconds{20});
            bool found = false;
            for (const auto& pose : client.poll()) found = found || good(last = pose);
            return found;
        });
        return came ? testing::AssertionSuccess()
                    : testing::AssertionFailure() << last << '\n'
                                                  << test::read_all(folder_ / "log");
    }

    /// Within what a wide box of a small picture leaves unsure.
    bool is_the_walker(const nlohmann::json& pose) const {
        const auto& p = pose["position_site_m"];
        return (Eigen::Vector2d(p[0].get<double>(), p[1].get<double>()) - walker_now_m()).norm() < 0.8;
    }

    test::TemporaryFolder folder_;
    std::unique_ptr<test::FakeDevice> device_;
    std::unique_ptr<test::DaemonProcess> daemon_;
    std::chrono::time_point<std::chrono::steady_clock, std::chrono::duration<double>> first_picture_;
    test::TrekTag tag_;
};

TEST_F(CameraDaemon, NamesWhomItSeesAndCarriesHimWhenHisTagFallsSilent) {
    start();
    SocketClient client{folder_ / "locusd.sock"};
    synchronise(client);
    ASSERT_TRUE(pose_comes(client, true, [&](const nlohmann::json& pose) {
        return pose["target"] == "walker" && pose.contains("seen_as") && pose["seen_as"]["camera"] == "gate" &&
               is_the_walker(pose);
    }));
    const auto camera = client.ask("?SOURCES;", "SOURCES")["inputs"][1];
    EXPECT_EQ(camera["name"], "gate");
    EXPECT_EQ(camera["state"], "open");
    EXPECT_GT(camera["measurements"], 0);
    const std::string jpeg = client.ask("?VIEW={\"camera\":\"gate\"};", "VIEW").value("jpeg_base64", "");
    EXPECT_TRUE(jpeg.starts_with("/9j/")) << "as every JPEG file in base64";
    EXPECT_NE(client.ask("?VIEW={\"camera\":\"door\"};", "ERROR").value("message", "").find("gate"), std::string::npos);
    std::this_thread::sleep_for(std::chrono::seconds{2}); // twice lost_after_s
    EXPECT_TRUE(pose_comes(client, false, [&](const nlohmann::json& pose) {
        return pose["target"] == "walker" && is_the_walker(pose) && pose["kinds_used"] == nlohmann::json{"FOOT_POINT"};
    }));
}

TEST_F(CameraDaemon, PeopleWithoutATagAreTargetsWhereThatIsWanted) {
    start("vision: {anonymous: true}\n");
    SocketClient client{folder_ / "locusd.sock"};
    synchronise(client);
    EXPECT_TRUE(pose_comes(client, false, [&](const nlohmann::json& pose) {
        return pose["target"] == "anonymous-1-1" && is_the_walker(pose);
    }));
}

TEST_F(CameraDaemon, GoesOnWithoutACalibrationAndSaysSo) {
    std::filesystem::remove(folder_ / "gate.yaml");
    start();
    SocketClient client{folder_ / "locusd.sock"};
    ASSERT_TRUE(client.connected()) << test::read_all(folder_ / "log");
    EXPECT_TRUE(eventually([&] {
        const auto inputs = client.ask("?SOURCES;", "SOURCES")["inputs"];
        return inputs.size() == 2 && inputs[1].value("error", "").find("gate.yaml") != std::string::npos;
    })) << test::read_all(folder_ / "log");
    synchronise(client);
    EXPECT_TRUE(pose_comes(client, true, [&](const nlohmann::json& pose) { return is_the_walker(pose); }));
}

} // namespace
} // namespace locus
