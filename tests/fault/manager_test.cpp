// The daemon as a service manager sees it: notifications, the watchdog's food, a socket handed over.
#include "tests/support/daemon_process.h"
#include "tests/support/socket_client.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/un.h>

#include <memory>

namespace locus {
namespace {

using test::eventually;

/// Stands in for systemd: the datagram socket that NOTIFY_SOCKET names.
class NotifySocket {
  public:
    explicit NotifySocket(std::string path) : path_{std::move(path)}, fd_{::socket(AF_UNIX, SOCK_DGRAM, 0)} {
        sockaddr_un address{};
        address.sun_family = AF_UNIX;
        std::ranges::copy(path_, address.sun_path);
        ::bind(fd_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address);
    }

    const std::string& path() const { return path_; }

    /// Waits for a message that holds `text`.
    bool hears(std::string_view text, std::chrono::milliseconds patience = test::patience) const {
        const auto deadline = test::steady_clock::now() + patience;
        while (test::steady_clock::now() < deadline) {
            pollfd waiting{fd_.get(), POLLIN, 0};
            if (::poll(&waiting, 1, 50) <= 0) continue;
            char bytes[4096];
            const ssize_t got = ::recv(fd_.get(), bytes, sizeof bytes, 0);
            if (got > 0 && std::string_view{bytes, static_cast<std::size_t>(got)}.find(text) != std::string_view::npos)
                return true;
        }
        return false;
    }

  private:
    std::string path_;
    UniqueFd fd_;
};

class ManagerTest : public ::testing::Test {
  protected:
    ManagerTest() { test::write_all(config_, "site: {name: bare}\npublish: {socket: " + socket_ + "}\n"); }

    void start(const std::function<void()>& prepare) {
        daemon_ = std::make_unique<test::DaemonProcess>(std::vector<std::string>{"--config", config_}, log_, prepare);
    }

    void start_with_watchdog() {
        start([this] {
            ::setenv("NOTIFY_SOCKET", manager_.path().c_str(), 1);
            ::setenv("WATCHDOG_USEC", "2000000", 1);
            ::setenv("WATCHDOG_PID", std::to_string(::getpid()).c_str(), 1);
            ::setenv("LOCUSD_DEBUG_STALL_SIGNAL", "1", 1);
        });
    }

    test::TemporaryFolder folder_;
    std::string config_ = folder_ / "locusd.yaml";
    std::string socket_ = folder_ / "locusd.sock";
    std::string log_ = folder_ / "log";
    NotifySocket manager_{folder_ / "notify"};
    std::unique_ptr<test::DaemonProcess> daemon_;
};

TEST_F(ManagerTest, HearsThatItIsReadyHowItDoesAndThatItStops) {
    start_with_watchdog();
    EXPECT_TRUE(manager_.hears("READY=1")) << test::read_all(log_);
    EXPECT_TRUE(manager_.hears("STATUS=0 of 0 inputs open, 0 targets have a position, 100 Hz"));
    EXPECT_TRUE(manager_.hears("WATCHDOG=1"));
    daemon_->signal(SIGHUP);
    EXPECT_TRUE(manager_.hears("RELOADING=1"));
    EXPECT_TRUE(manager_.hears("READY=1"));
    daemon_->signal(SIGTERM);
    EXPECT_TRUE(manager_.hears("STOPPING=1"));
}

TEST_F(ManagerTest, TheWatchdogIsFedNoMoreWhenTheFusionThreadStalls) {
    start_with_watchdog();
    ASSERT_TRUE(manager_.hears("WATCHDOG=1")) << test::read_all(log_);
    daemon_->signal(SIGUSR2);
    // What was on its way may still come; after it, silence for longer than the watchdog waits.
    EXPECT_TRUE(eventually([&] { return !manager_.hears("WATCHDOG=1", std::chrono::milliseconds{2000}); }));
    EXPECT_FALSE(daemon_->exit_code().has_value()) << "alive, but told on";
}

TEST_F(ManagerTest, WithoutTheEnvironmentsLeaveTheDebugHookIsNotThere) {
    start([] {});
    ASSERT_TRUE(test::SocketClient{socket_}.connected());
    daemon_->signal(SIGUSR2);
    std::optional<int> code;
    EXPECT_TRUE(eventually([&] { return (code = daemon_->exit_code()).has_value(); }));
    EXPECT_EQ(code, 128 + SIGUSR2) << "the signal's ordinary effect";
}

TEST_F(ManagerTest, ASocketThatWasHandedOverIsServedAndNotRemoved) {
    UniqueFd listener{::socket(AF_UNIX, SOCK_STREAM, 0)};
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string path = folder_ / "given.sock";
    std::ranges::copy(path, address.sun_path);
    ASSERT_EQ(::bind(listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    ASSERT_EQ(::listen(listener.get(), 8), 0);
    start([&] {
        ::dup2(listener.get(), 3);
        ::setenv("LISTEN_FDS", "1", 1);
        ::setenv("LISTEN_PID", std::to_string(::getpid()).c_str(), 1);
    });
    test::SocketClient client{path};
    EXPECT_EQ(client.next("VERSION")["site"], "bare") << test::read_all(log_);
    daemon_->signal(SIGTERM);
    EXPECT_TRUE(client.sees_the_end());
    EXPECT_TRUE(std::filesystem::exists(path));
    EXPECT_FALSE(std::filesystem::exists(socket_));
}

} // namespace
} // namespace locus
