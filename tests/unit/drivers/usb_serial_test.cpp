// The serial transport on a real USB serial port: the kernel's gadget driver is its other end (/dev/ttyGS0). Skipped
// where there is none; the rig of tests/hil runs it in its virtual machine.
#include "drivers/input.h"
#include "drivers/transport/unique_fd.h"
#include "tests/unit/drivers/transport_fixture.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <termios.h>

#include <cstdlib>
#include <fstream>
#include <thread>

namespace locus {
namespace {

using namespace testing_transport;
using namespace std::chrono_literals;
using testing::HasSubstr;

constexpr auto port = "/dev/ttyACM0";
constexpr auto gadget = "/dev/ttyGS0";

class UsbSerial : public testing::Test {
  protected:
    void SetUp() override {
        if (!std::filesystem::exists(gadget) || !std::filesystem::exists(port)) GTEST_SKIP() << "no USB serial gadget";
        // Its USB device stays when the port goes: this is how it is plugged in again.
        authorized_ = std::filesystem::canonical("/sys/class/tty/ttyACM0/device/..") / "authorized";
        std::filesystem::create_symlink(port, by_id_);
        open_gadget();
    }

    /// Anew after each unplugging: the kernel hangs it up.
    void open_gadget() {
        device_.reset(::open(gadget, O_RDWR | O_NOCTTY));
        termios terminal{};
        ::tcgetattr(device_.get(), &terminal);
        ::cfmakeraw(&terminal);
        ASSERT_EQ(::tcsetattr(device_.get(), TCSANOW, &terminal), 0);
    }

    void plug(bool in) const { std::ofstream{authorized_} << in; }
    bool device_says(std::string_view text) const {
        return ::write(device_.get(), text.data(), text.size()) == ssize_t(text.size());
    }
    std::unique_ptr<Transport> serial() const { return make_transport("serial", {{"path", by_id_}}); }

    test::TemporaryFolder folder_;
    const std::string by_id_ = folder_ / "usb-tag";
    std::filesystem::path authorized_;
    UniqueFd device_;
    KeepingSink sink_;
};

TEST_F(UsbSerial, BytesPassWithTheTimeOfAByte) {
    const auto serial = this->serial();
    ASSERT_TRUE(serial->open()) << serial->last_error();
    const std::string wire{"mc 0f\r\n\x03\x11\x13\x00\xff", 12};
    ASSERT_TRUE(device_says(wire));
    ASSERT_EQ(read_bytes(*serial, sink_, wire.size()), ReadStatus::ok);
    EXPECT_EQ(sink_.text, wire);
    EXPECT_EQ(sink_.kept.front().packet.byte_time, Duration{86'806}) << "10 bits at 115200 Bd";
}

TEST_F(UsbSerial, ALongChunkIsDatedPieceByPiece) {
    const auto serial = this->serial();
    ASSERT_TRUE(serial->open()) << serial->last_error();
    ASSERT_TRUE(device_says(std::string(300, 'x')));
    std::this_thread::sleep_for(200ms); // so that one read takes it all
    ASSERT_EQ(read_bytes(*serial, sink_, 300), ReadStatus::ok);
    ASSERT_EQ(sink_.kept.size(), 3u);
    for (const auto& kept : sink_.kept) EXPECT_LE(kept.data.size(), 128u);
    const Duration apart = sink_.kept[2].packet.time - sink_.kept[1].packet.time;
    EXPECT_LE(std::chrono::abs(apart - 44 * Duration{86'806}), 1us) << "the last piece has 44 bytes";
}

TEST_F(UsbSerial, IsExclusive) {
    const auto serial = this->serial(), other = this->serial();
    ASSERT_TRUE(serial->open()) << serial->last_error();
    EXPECT_FALSE(other->open());
    EXPECT_THAT(std::string{other->last_error()}, HasSubstr("in use by another program"));
    serial->close();
    EXPECT_TRUE(other->open()) << other->last_error();
}

TEST_F(UsbSerial, AnInputSurvivesUnplugAndReplug) {
    Input input{{.name = "tag", .transport = serial(), .tap = &sink_}};
    std::jthread thread{[&](std::stop_token stop) { input.run(stop); }};
    const auto until = [&](auto condition) {
        for (int i = 0; i < 1000 && !condition(); ++i) std::this_thread::sleep_for(10ms);
        return condition();
    };
    const auto is = [&](InputState state) { return until([&] { return input.status().state == state; }); };
    ASSERT_TRUE(is(InputState::open)) << input.status().trouble.get();
    ASSERT_TRUE(device_says("one") && until([&] { return input.status().bytes >= 3; }));
    plug(false);
    ASSERT_TRUE(is(InputState::waiting));
    EXPECT_THAT(input.status().trouble.get(), testing::AnyOf(HasSubstr("is gone"), HasSubstr("is not there")));
    plug(true);
    ASSERT_TRUE(is(InputState::open)) << input.status().trouble.get();
    open_gadget();
    EXPECT_TRUE(device_says("two") && until([&] { return input.status().bytes >= 6; }));
    thread.request_stop();
    thread.join();
    EXPECT_EQ(sink_.text, "onetwo");
    EXPECT_EQ(input.status().reconnects, 1u);
}

} // namespace
} // namespace locus
