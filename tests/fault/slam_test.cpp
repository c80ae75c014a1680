// Somebody else's SLAM feeds the daemon: a tag behind a pseudo-terminal, poses as TUM lines over TCP, in a frame, a
// unit and a clock of their own. Whoever carries both walks to and fro in curves; the pose tells what a unit is in
// metres.
#include "drivers/slam/tum.h"
#include "fusion/geometry/rotation.h"
#include "tests/support/daemon_process.h"
#include "tests/support/socket_client.h"
#include "tests/support/tcp_server.h"
#include "tests/support/trek_tag.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace locus {
namespace {

using test::SocketClient;

constexpr test::TrekTag::Anchors hall_anchors_m{{{0, 0, 3.5}, {20, 0, 0.5}, {20, 16, 3.5}, {0, 16, 0.5}}};
constexpr double range_noise_m = 0.05;
constexpr double tracking_s = 0.04;       ///< so long the SLAM computes
constexpr double slam_epoch_s = 1.3118e9; ///< its clock is not the host's

/// An eight, at up to 4 m/s: the faster, the sooner is the scale known and the test done.
Eigen::Vector3d runner_m(double time_s) {
    return {10 + 7 * std::sin(0.4 * time_s), 8 + 4 * std::sin(0.8 * time_s), 1.2 + 0.3 * std::sin(time_s)};
}

/// One segment of the SLAM: where it began, how it was turned then, and what it took for a metre.
struct Map {
    double metres_per_unit;
    Eigen::Quaterniond slam_from_site;

    slam::TumPose pose(double time_s) const {
        const Eigen::Vector3d p = slam_from_site * (runner_m(time_s) - runner_m(0)) / metres_per_unit;
        const Eigen::Quaterniond& q = slam_from_site;
        return {slam_epoch_s + time_s, {p.x(), p.y(), p.z()}, {q.x(), q.y(), q.z(), q.w()}};
    }
};

class SlamDaemon : public ::testing::Test {
  protected:
    SlamDaemon() {
        test::write_all(folder_ / "locusd.yaml", fmt::format(R"(site:
  name: hall
  anchors:
{}inputs:
  - {{name: tag, transport: pty, path: {folder}/tag, decoder: trek1000, tag_offset: 16}}
  - {{name: slam, transport: tcp, host: 127.0.0.1, port: {port}, decoder: tum, tag: 16}}
targets: [{{name: runner, address: 16, estimator: visual_scale}}]
estimators: {{visual_scale: {{known_below: 0.05}}}}
publish: {{socket: {folder}/locusd.sock}}
)",
                                                             tag_.anchors_yaml(), fmt::arg("folder", folder_.path()),
                                                             fmt::arg("port", slam_.port())));
        daemon_ = std::make_unique<test::DaemonProcess>(std::vector<std::string>{"--config", folder_ / "locusd.yaml"},
                                                        folder_ / "log");
    }

    double now_s() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

    /// Tag and SLAM go on until a pose of the runner is `good`.
    template <class Condition>
    testing::AssertionResult pose_comes(SocketClient& client, const Map& map, Condition good) {
        nlohmann::json last;
        const bool came = test::eventually([&] {
            device_.send(encode(tag_.report_at(runner_m(now_s()))));
            slam_.send(encode(map.pose(now_s() - tracking_s)));
            std::this_thread::sleep_for(std::chrono::milliseconds{30});
            bool found = false;
            for (const auto& pose : client.poll()) found = found || good(last = pose);
            return found;
        });
        std::printf("after %.1f s: %s\n", now_s(), last.value("odometry_scale", nlohmann::json{}).dump().c_str());
        return came ? testing::AssertionSuccess()
                    : testing::AssertionFailure() << last << '\n'
                                                  << test::read_all(folder_ / "log");
    }

    static bool tells_scale(const nlohmann::json& pose) {
        return pose.contains("odometry_scale") && pose["odometry_scale"].contains("metres_per_unit");
    }
    static void expect_scale(const nlohmann::json& pose, double metres_per_unit) {
        const auto& scale = pose["odometry_scale"];
        EXPECT_LT(scale["relative_sigma"].get<double>(), 0.05);
        EXPECT_NEAR(scale["metres_per_unit"].get<double>() / metres_per_unit, 1, 0.05) << "one sigma at most";
    }

    test::TrekTag tag_{hall_anchors_m, range_noise_m};
    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    test::TemporaryFolder folder_;
    test::FakeDevice device_{folder_ / "tag"};
    test::TcpServer slam_;
    std::unique_ptr<test::DaemonProcess> daemon_;
};

TEST_F(SlamDaemon, TellsTheScaleOfASlamAndFindsItAnewAfterALoss) {
    SocketClient client{folder_ / "locusd.sock"};
    ASSERT_TRUE(client.connected()) << test::read_all(folder_ / "log");
    nlohmann::json pose;
    const auto told = [&](const nlohmann::json& one) {
        pose = one;
        return tells_scale(one);
    };
    const Map first{2.2, rotation({0.4, -1.2, 2.0})}, second{0.6, rotation({-1.5, 0.3, -0.7})};
    ASSERT_TRUE(pose_comes(client, first, told));
    expect_scale(pose, first.metres_per_unit);
    EXPECT_TRUE(pose_comes(client, first, [](const nlohmann::json& one) {
        const auto kinds = one["kinds_used"].get<std::vector<std::string>>();
        return std::ranges::find(kinds, "VISUAL_ODOMETRY") != kinds.end();
    }));
    slam_.send("# lost\n");
    ASSERT_TRUE(pose_comes(client, second, [](const nlohmann::json& one) { return !tells_scale(one); }));
    ASSERT_TRUE(pose_comes(client, second, told));
    expect_scale(pose, second.metres_per_unit);
    const auto& p = pose["position_site_m"];
    const Eigen::Vector3d here_m(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
    EXPECT_LT((here_m - runner_m(now_s())).head<2>().norm(), 0.5);
    const auto input = client.ask("?SOURCES;", "SOURCES")["inputs"][1];
    EXPECT_EQ(input["name"], "slam");
    EXPECT_TRUE(input["refused"].empty()) << input;
}

} // namespace
} // namespace locus
