// The daemon as its users meet it: bytes into a pseudo-terminal, poses out of the socket, and everything that goes
// wrong on the way.
#include "tests/support/daemon_process.h"
#include "tests/support/sanitizer.h"
#include "tests/support/socket_client.h"
#include "tests/support/trek_tag.h"

#include <sched.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>

namespace locus {
namespace {

using test::eventually;
using test::SocketClient;

class DaemonTest : public ::testing::Test {
  protected:
    DaemonTest() {
        test::write_all(config_, config());
        device_ = std::make_unique<test::FakeDevice>(folder_ / "tag");
    }

    /// Four anchors in the corners of a hall, one tag behind a pseudo-terminal.
    std::string config(double rate_hz = 50, const std::string& more = "") const {
        return fmt::format(R"(site:
  name: hall
  anchors:
{}inputs:
  - {{name: tag, transport: pty, path: {}, decoder: trek1000, tag_offset: 16}}
targets:
  - {{name: walker, address: 16}}
fusion: {{rate_hz: {}}}
publish: {{socket: {}}}
{})",
                           tag_.anchors_yaml(), folder_ / "tag", rate_hz, socket_, more);
    }

    void start() {
        daemon_ = std::make_unique<test::DaemonProcess>(std::vector<std::string>{"--config", config_}, log_);
    }

    /// One report of a tag at (x, y, 1), as the device prints it.
    void report(double x, double y) { device_->send(encode(tag_.report_at({x, y, 1}))); }

    /// Reports until the newest pose satisfies `good`.
    template <class Condition>
    testing::AssertionResult reports_until(SocketClient& client, double x, double y, Condition good) {
        const bool done = eventually([&] {
            report(x, y);
            std::this_thread::sleep_for(std::chrono::milliseconds{20});
            const auto poses = client.poll();
            return !poses.empty() && good(poses.front());
        });
        return done ? testing::AssertionSuccess() : testing::AssertionFailure() << test::read_all(log_);
    }

    testing::AssertionResult comes_to(SocketClient& client, double x, double y) {
        return reports_until(client, x, y, [&](const nlohmann::json& pose) {
            const auto& p = pose["position_site_m"];
            return std::hypot(p[0].get<double>() - x, p[1].get<double>() - y) < 0.2;
        });
    }

    testing::AssertionResult ends_with(int code) {
        std::optional<int> got;
        const bool ended = eventually([&] { return (got = daemon_->exit_code()).has_value(); });
        if (ended && *got == code) return testing::AssertionSuccess();
        return testing::AssertionFailure() << (ended ? fmt::format("exit code {}", *got) : "still runs") << "\n"
                                           << test::read_all(log_);
    }

    test::TemporaryFolder folder_;
    std::string config_ = folder_ / "locusd.yaml";
    std::string socket_ = folder_ / "locusd.sock";
    std::string log_ = folder_ / "log";
    std::unique_ptr<test::FakeDevice> device_;
    std::unique_ptr<test::DaemonProcess> daemon_;
    test::TrekTag tag_;
};

TEST_F(DaemonTest, RangesGoInAndThePoseComesOut) {
    start();
    SocketClient client{socket_};
    ASSERT_TRUE(client.connected()) << test::read_all(log_);
    EXPECT_EQ(client.next("VERSION")["site"], "hall");
    ASSERT_TRUE(comes_to(client, 3, 5));
    const auto status = client.ask("?STATUS;", "STATUS");
    EXPECT_EQ(status["working"], true);
    EXPECT_GT(status["engine"]["received"], 0);
    const auto sources = client.ask("?SOURCES;", "SOURCES");
    ASSERT_EQ(sources["sources"].size(), 4u);
    EXPECT_EQ(sources["sources"][0]["name"], "A0");
    EXPECT_EQ(sources["sources"][0]["input"], "tag");
    EXPECT_EQ(sources["inputs"][0]["state"], "open");
    EXPECT_GT(sources["inputs"][0]["measurements"], 0);
    EXPECT_EQ(client.ask("?TARGETS;", "TARGETS")["targets"][0]["name"], "walker");
}

TEST_F(DaemonTest, TheStreamHasOnePosePerTickInTimeOrder) {
    start();
    SocketClient client{socket_};
    ASSERT_TRUE(comes_to(client, 3, 5));
    client.ask("?WATCH={};", "WATCH");
    double last = client.next("POSE")["time"];
    for (int i = 0; i < 50; ++i) {
        const double time = client.next("POSE")["time"];
        const double periods = (time - last) * 50;
        ASSERT_GT(periods, 0.5);
        ASSERT_NEAR(periods, std::round(periods), 1e-3) << "whole periods, also where the machine was late";
        last = time;
    }
}

TEST_F(DaemonTest, SigtermAndSigintStopItCleanlyWithinASecond) {
    for (const int signal : {SIGTERM, SIGINT}) {
        start();
        SocketClient client{socket_};
        ASSERT_TRUE(comes_to(client, 3, 5));
        const auto before = test::steady_clock::now();
        daemon_->signal(signal);
        ASSERT_TRUE(ends_with(0));
        if (!test::under_sanitizer) {
            EXPECT_LT(test::steady_clock::now() - before, std::chrono::seconds{1});
        }
        EXPECT_TRUE(client.sees_the_end());
        EXPECT_FALSE(std::filesystem::exists(socket_));
    }
}

TEST_F(DaemonTest, ADeviceThatIsUnpluggedIsFoundAgain) {
    start();
    SocketClient client{socket_};
    ASSERT_TRUE(comes_to(client, 3, 5));
    const auto input_state = [&](const char* wanted) {
        return eventually([&] { return client.ask("?SOURCES;", "SOURCES")["inputs"][0]["state"] == wanted; });
    };
    device_.reset();
    ASSERT_TRUE(input_state("waiting")) << test::read_all(log_);
    device_ = std::make_unique<test::FakeDevice>(folder_ / "tag");
    ASSERT_TRUE(input_state("open")) << test::read_all(log_);
    ASSERT_TRUE(comes_to(client, 3, 5));
    EXPECT_EQ(client.ask("?SOURCES;", "SOURCES")["inputs"][0]["reconnects"], 1);
}

TEST_F(DaemonTest, WithoutItsDeviceItRunsAndSaysWhatIsMissing) {
    device_.reset();
    start();
    SocketClient client{socket_};
    ASSERT_TRUE(eventually([&] {
        return client.ask("?STATUS;", "STATUS").dump().find("plugged in or its program running?") != std::string::npos;
    }));
    device_ = std::make_unique<test::FakeDevice>(folder_ / "tag");
    ASSERT_TRUE(comes_to(client, 3, 5));
}

TEST_F(DaemonTest, AMistakeInTheConfigurationIsToldAndNothingStarts) {
    test::write_all(config_, config(50, "fussion: {}\n"));
    start();
    ASSERT_TRUE(ends_with(2));
    const std::string log = test::read_all(log_);
    EXPECT_NE(log.find(config_ + ":14:1: "), std::string::npos) << log;
    EXPECT_FALSE(std::filesystem::exists(socket_));
}

TEST_F(DaemonTest, CheckSaysSoAndStartsNothing) {
    daemon_ = std::make_unique<test::DaemonProcess>(std::vector<std::string>{"--check", "--config", config_}, log_);
    ASSERT_TRUE(ends_with(0));
    EXPECT_NE(test::read_all(log_).find("no mistakes found"), std::string::npos);
    daemon_ = std::make_unique<test::DaemonProcess>(std::vector<std::string>{"--chekc"}, log_);
    ASSERT_TRUE(ends_with(2));
}

TEST_F(DaemonTest, ARecordingThatIsThereIsNotOverwritten) {
    test::write_all(folder_ / "precious.log", "precious\n");
    daemon_ = std::make_unique<test::DaemonProcess>(
        std::vector<std::string>{"--config", config_, "--record", folder_ / "precious.log"}, log_);
    ASSERT_TRUE(ends_with(1));
    EXPECT_NE(test::read_all(log_).find("is there already: take another name"), std::string::npos);
    EXPECT_EQ(test::read_all(folder_ / "precious.log"), "precious\n");
}

TEST_F(DaemonTest, EveryThreadThatAMeasurementPassesIsRealTimeTheFusionThreadAboveTheRest) {
    start();
    SocketClient client{socket_};
    ASSERT_TRUE(comes_to(client, 3, 5));
    if (client.ask("?STATUS;", "STATUS")["realtime"] != true) GTEST_SKIP() << "real-time scheduling is not allowed";
    std::map<std::string, int> priorities;
    for (const auto& task : std::filesystem::directory_iterator(fmt::format("/proc/{}/task", daemon_->pid()))) {
        sched_param parameters{};
        ::sched_getparam(std::stoi(task.path().filename()), &parameters);
        std::string name = test::read_all(task.path() / "comm");
        name.pop_back();
        priorities[name] = parameters.sched_priority;
    }
    EXPECT_EQ(priorities["fusion"], 50);
    EXPECT_EQ(priorities["tag"], 49);
    EXPECT_EQ(priorities["publisher"], 49);
    EXPECT_EQ(priorities["locusd"], 0) << "what is slow is not real-time";
}

TEST_F(DaemonTest, ASecondDaemonDoesNotTakeTheSocketAway) {
    start();
    SocketClient client{socket_};
    ASSERT_TRUE(comes_to(client, 3, 5));
    test::DaemonProcess second{{"--config", config_}, log_};
    std::optional<int> code;
    ASSERT_TRUE(eventually([&] { return (code = second.exit_code()).has_value(); }));
    EXPECT_EQ(*code, 1);
    EXPECT_NE(test::read_all(log_).find("another locusd listens there already"), std::string::npos);
    ASSERT_TRUE(comes_to(client, 3, 5));
}

TEST_F(DaemonTest, AReloadWithAMistakeKeepsTheOldConfiguration) {
    start();
    SocketClient client{socket_};
    ASSERT_TRUE(comes_to(client, 3, 5));
    test::write_all(config_, config(50, "fussion: {}\n"));
    const auto answer = client.ask("?RELOAD;", "RELOAD");
    EXPECT_EQ(answer["ok"], false);
    EXPECT_NE(answer["problems"].dump().find(":14:1: "), std::string::npos) << answer;
    ASSERT_TRUE(comes_to(client, 3, 5));
}

TEST_F(DaemonTest, AReloadOfTheSameConfigurationInterruptsNothing) {
    start();
    SocketClient client{socket_};
    ASSERT_TRUE(comes_to(client, 3, 5));
    const auto before = client.ask("?POLL;", "POSE");
    EXPECT_EQ(client.ask("?RELOAD;", "RELOAD")["ok"], true);
    const auto after = client.ask("?POLL;", "POSE");
    EXPECT_EQ(after["reset_count"], before["reset_count"]) << "the filter went on";
    EXPECT_EQ(client.ask("?SOURCES;", "SOURCES")["inputs"][0]["reconnects"], 0) << "the device stayed open";
}

TEST_F(DaemonTest, SighupBringsANewConfigurationIntoForce) {
    start();
    SocketClient client{socket_};
    ASSERT_TRUE(comes_to(client, 3, 5));
    const unsigned resets = client.ask("?POLL;", "POSE")["reset_count"];
    test::write_all(config_, config(100));
    daemon_->signal(SIGHUP);
    ASSERT_TRUE(eventually([&] { return client.ask("?STATUS;", "STATUS")["rate_hz"] == 100; })) << test::read_all(log_);
    ASSERT_TRUE(comes_to(client, 6, 2));
    EXPECT_GT(client.ask("?POLL;", "POSE")["reset_count"], resets) << "another engine started from nothing";
    const auto input = client.ask("?SOURCES;", "SOURCES")["inputs"][0];
    EXPECT_EQ(input["reconnects"], 0) << "an input that did not change stays open";
}

TEST_F(DaemonTest, AReloadMayTakeAwayAndBringInputs) {
    start();
    SocketClient client{socket_};
    ASSERT_TRUE(comes_to(client, 3, 5));
    std::string other = config();
    other.replace(other.find("tag_offset: 16"), 14, "tag_offset: 17");
    test::write_all(config_, other);
    EXPECT_EQ(client.ask("?RELOAD;", "RELOAD")["ok"], true);
    ASSERT_TRUE(eventually([&] {
        report(3, 5);
        return client.ask("?TARGETS;", "TARGETS").dump().find("0x11") != std::string::npos;
    })) << test::read_all(log_);
}

TEST_F(DaemonTest, NoiseOnTheWireIsCountedAndPositionsGoOn) {
    start();
    SocketClient client{socket_};
    for (int i = 0; i < 20; ++i) device_->send("\xff\xfe mc zz\r\nmc 0f 0000\r\n\x00garbage\n");
    ASSERT_TRUE(comes_to(client, 3, 5));
    EXPECT_GT(client.ask("?SOURCES;", "SOURCES")["inputs"][0]["refused"].size(), 0u);
}

} // namespace
} // namespace locus
