// A vehicle that stands in its yard, in a whole daemon: a u-blox with two antennas and a VectorNav behind
// pseudo-terminals. It has never driven, and yet its pose tells where it points.
#include "drivers/gnss/ubx_messages.h"
#include "drivers/imu/vectornav.h"
#include "tests/support/daemon_process.h"
#include "tests/support/fake_device.h"
#include "tests/support/socket_client.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

namespace locus {
namespace {

using test::SocketClient;

constexpr double gravity_mps2 = 9.798;
constexpr double antennas_heading_deg = 123.4; ///< the second antenna lies left of the first
constexpr double forward_heading_deg = antennas_heading_deg + 90;

std::string text_of(const std::vector<std::uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

class StandingVehicle : public ::testing::Test {
  protected:
    StandingVehicle() {
        test::write_all(folder_ / "locusd.yaml", fmt::format(R"(site:
  name: yard
  origin: {{latitude_deg: 35.6675740, longitude_deg: 139.7910740, height_ellipsoid_m: 39.5}}
inputs:
  - {{name: gnss, transport: pty, path: {folder}/gnss, decoder: ubx, tag: 7}}
  - {{name: imu, transport: pty, path: {folder}/imu, decoder: vectornav, tag: 7}}
targets: [{{name: loader, address: 7, estimator: gnss_ins}}]
estimators: {{gnss_ins: {{heading_mounting_deg: 90, heading_baseline_m: 0.8}}}}
publish: {{socket: {folder}/locusd.sock}}
)",
                                                             fmt::arg("folder", folder_.path())));
        daemon_ = std::make_unique<test::DaemonProcess>(std::vector<std::string>{"--config", folder_ / "locusd.yaml"},
                                                        folder_ / "log");
    }

    double now_s() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count(); }

    /// Ten milliseconds of the devices.
    void go_on(int baseline_cm) {
        imu::VectorNavData still;
        still.time_startup_ns = static_cast<std::uint64_t>(1e9 * now_s());
        still.rate_radps = Vec3{};
        still.acceleration_mps2 = Vec3{0, 0, gravity_mps2};
        imu_.send(text_of(encode(still)));
        if (++ticks_ % 20 == 0) tell_place(baseline_cm);
        std::this_thread::sleep_for(std::chrono::milliseconds{10});
    }

    void tell_place(int baseline_cm) {
        gnss::ubx::NavPvt pvt;
        pvt.time_of_week_ms = static_cast<std::uint32_t>(560'000'000 + 1000 * now_s());
        pvt.valid = 7;
        pvt.fix_type = 3;
        pvt.flags = 1;
        pvt.satellites = 14;
        pvt.latitude_1e7_deg = 356'675'740;
        pvt.longitude_1e7_deg = 1'397'910'740;
        pvt.height_ellipsoid_mm = 39'500;
        pvt.sigma_horizontal_mm = pvt.sigma_vertical_mm = 800;
        pvt.sigma_speed_mmps = 50;
        gnss::ubx::RelativePosition relative;
        relative.time_of_week_ms = pvt.time_of_week_ms;
        relative.length_cm = baseline_cm;
        relative.heading_1e5_deg = static_cast<std::int32_t>(antennas_heading_deg * 1e5);
        relative.sigma_heading_1e5_deg = 40'000;
        relative.flags = 0x137;
        gnss_.send(text_of(encode(pvt)) + text_of(encode(relative)));
    }

    template <class Condition>
    testing::AssertionResult pose_comes(SocketClient& client, int baseline_cm, Condition good) {
        nlohmann::json last;
        const bool came = test::eventually([&] {
            go_on(baseline_cm);
            bool found = false;
            for (const auto& pose : client.poll()) found = found || good(last = pose);
            return found;
        });
        return came ? testing::AssertionSuccess()
                    : testing::AssertionFailure() << last << test::read_all(folder_ / "log");
    }

    static nlohmann::json heading_source(SocketClient& client) {
        const auto answer = client.ask("?SOURCES;", "SOURCES");
        for (const auto& source : answer["sources"])
            if (source["kind"] == "heading") return source;
        return nlohmann::json::object();
    }

    testing::AssertionResult source_comes(SocketClient& client, int baseline_cm, std::string_view reason) {
        const bool came = test::eventually([&] {
            go_on(baseline_cm);
            return ticks_ % 20 == 0 && heading_source(client).value("reason", "") == reason;
        });
        return came ? testing::AssertionSuccess() : testing::AssertionFailure() << heading_source(client);
    }

    test::TemporaryFolder folder_;
    test::FakeDevice gnss_{folder_ / "gnss"}, imu_{folder_ / "imu"};
    const std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
    int ticks_ = 0;
    std::unique_ptr<test::DaemonProcess> daemon_;
};

bool tells_attitude(const nlohmann::json& pose) { return pose.contains("orientation_xyzw"); }

TEST_F(StandingVehicle, KnowsWhereItPointsAndSaysWhenACycleIsMiscounted) {
    SocketClient client{folder_ / "locusd.sock"};
    ASSERT_TRUE(client.connected()) << test::read_all(folder_ / "log");
    nlohmann::json pose;
    ASSERT_TRUE(pose_comes(client, 80, [&](const nlohmann::json& one) { return tells_attitude(pose = one); }));
    const auto q = pose["orientation_xyzw"].get<std::array<double, 4>>();
    const Eigen::Vector3d forward = Eigen::Quaterniond(q[3], q[0], q[1], q[2]) * Eigen::Vector3d::UnitX();
    const double heading_deg = std::atan2(forward.x(), forward.y()) * 180 / std::numbers::pi;
    EXPECT_NEAR(std::remainder(heading_deg - forward_heading_deg, 360), 0, 1);
    EXPECT_NEAR(forward.z(), 0, 0.01);
    ASSERT_TRUE(source_comes(client, 80, "used"));
    EXPECT_NEAR(heading_source(client)["observation"].get<double>(), antennas_heading_deg, 1e-3);
    EXPECT_TRUE(source_comes(client, 95, "wrong_baseline"));
}

} // namespace
} // namespace locus
