// The CAN transport on a real (virtual) interface. Needs root and a kernel with vcan: skipped elsewhere; the rig of
// tests/hil runs it in its virtual machine.
#include "drivers/clock.h"
#include "drivers/input.h"
#include "drivers/transport/can_socket.h"
#include "tests/unit/drivers/transport_fixture.h"

#include <gmock/gmock.h>
#include <linux/can.h>

#include <cstdlib>
#include <thread>

namespace locus {
namespace {

using namespace testing_transport;
using namespace std::chrono_literals;
using testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

bool run(const std::string& command) { return std::system((command + " >/dev/null 2>&1").c_str()) == 0; }
bool add() { return run("ip link add dev locus0 type vcan") && run("ip link set locus0 mtu 72 up"); }
bool remove() { return run("ip link del locus0"); }

class Vcan : public testing::Test {
  protected:
    void SetUp() override {
        remove();
        if (!add()) GTEST_SKIP() << "needs root and a kernel with vcan";
    }
    void TearDown() override { remove(); }

    static std::unique_ptr<Transport> transport(const std::string& filter = "") {
        return make_transport("can", {{"interface", "locus0"}, {"filter", filter}});
    }

    static bool send(std::uint32_t id, const Bytes& data, bool fd = false) {
        CanSocket socket;
        std::string error;
        return socket.open("locus0", error) &&
               socket.send({.wire = Wire::can, .can_id = id, .can_fd_flags = CANFD_BRS, .can_fd = fd, .data = data});
    }

    KeepingSink sink;
};

TEST_F(Vcan, ClassicAndFdFramesWithKernelStamps) {
    const auto can = transport();
    ASSERT_TRUE(can->open()) << can->last_error();
    const Timestamp before = monotonic_now();
    ASSERT_TRUE(send(0x123, {1, 2, 3}));
    ASSERT_TRUE(send(0x18FF1234 | CAN_EFF_FLAG, Bytes(64, 9), true));
    const Timestamp sent = monotonic_now();
    std::this_thread::sleep_for(50ms); // the stamp is the kernel's, not that of reading
    ASSERT_EQ(read_bytes(*can, sink, 67), ReadStatus::ok);
    ASSERT_EQ(sink.kept.size(), 2u);
    EXPECT_EQ(sink.kept[0].packet.can_id, 0x123u);
    EXPECT_EQ(sink.kept[0].data, (Bytes{1, 2, 3}));
    EXPECT_FALSE(sink.kept[0].packet.can_fd);
    EXPECT_EQ(sink.kept[1].packet.can_id, 0x18FF1234 | CAN_EFF_FLAG);
    EXPECT_EQ(sink.kept[1].data, Bytes(64, 9));
    EXPECT_TRUE(sink.kept[1].packet.can_fd);
    EXPECT_EQ(sink.kept[1].packet.can_fd_flags, CANFD_BRS);
    for (const auto& kept : sink.kept) {
        EXPECT_GE(kept.packet.time, before - 1ms);
        EXPECT_LE(kept.packet.time, sent + 1ms);
        EXPECT_EQ(to_ns(kept.packet.time) % 1000, 0);
    }
}

TEST_F(Vcan, OnlyWantedIds) {
    const auto can = transport("200:7F0");
    ASSERT_TRUE(can->open()) << can->last_error();
    ASSERT_TRUE(send(0x123, {1}) && send(0x205, {2}) && send(0x205 | CAN_EFF_FLAG, {3}) && send(0x20F, {4}));
    ASSERT_EQ(read_bytes(*can, sink, 2), ReadStatus::ok);
    EXPECT_EQ(sink.text, "\x02\x04");
}

TEST_F(Vcan, ManyFramesInOrderAndTheKernelsDropsCounted) {
    const auto can = transport();
    ASSERT_TRUE(can->open());
    CanSocket socket;
    std::string error;
    ASSERT_TRUE(socket.open("locus0", error)) << error;
    constexpr std::uint32_t frames = 20'000; // more than a socket's buffer holds
    for (std::uint32_t i = 0; i < frames; ++i) {
        const Bytes data{std::uint8_t(i), std::uint8_t(i >> 8), std::uint8_t(i >> 16)};
        ASSERT_TRUE(socket.send({.wire = Wire::can, .can_id = 1, .data = data}));
    }
    while (!sink.kept.empty() || can->kernel_dropped() == 0) {
        sink.kept.clear();
        ASSERT_EQ(can->read(sink, 10ms), ReadStatus::ok);
        if (sink.kept.empty()) break;
    }
    const std::size_t received = sink.text.size() / 3;
    EXPECT_LT(received, frames);
    ASSERT_TRUE(send(1, {0, 0, 0})); // the count travels with the next frame
    ASSERT_EQ(read_bytes(*can, sink, sink.text.size() + 3), ReadStatus::ok);
    EXPECT_EQ(received + can->kernel_dropped(), frames);
}

TEST_F(Vcan, DownAndRemovedAreLossesWithTheirReason) {
    const auto can = transport();
    ASSERT_TRUE(can->open());
    ASSERT_TRUE(run("ip link set locus0 down"));
    ASSERT_EQ(read_until_lost(*can, sink), ReadStatus::lost);
    EXPECT_EQ(can->last_error(), "locus0 went down");
    can->close();
    EXPECT_FALSE(can->open());
    EXPECT_THAT(std::string{can->last_error()}, HasSubstr("ip link set locus0 up"));
    ASSERT_TRUE(run("ip link set locus0 up"));
    ASSERT_TRUE(can->open()) << can->last_error();
    ASSERT_TRUE(remove());
    ASSERT_EQ(read_until_lost(*can, sink), ReadStatus::lost);
    EXPECT_THAT(std::string{can->last_error()}, testing::AnyOf("locus0 was removed", "locus0 went down"));
    can->close();
    EXPECT_FALSE(can->open());
    EXPECT_THAT(std::string{can->last_error()}, HasSubstr("plugged in"));
}

TEST_F(Vcan, AnInputSurvivesDownUpAndUnplugReplug) {
    KeepingSink tap;
    Input input{{.name = "uwb", .transport = transport(), .tap = &tap}};
    std::jthread thread{[&](std::stop_token stop) { input.run(stop); }};
    const auto until = [&](auto condition) {
        for (int i = 0; i < 1000 && !condition(); ++i) std::this_thread::sleep_for(10ms);
        return condition();
    };
    const auto is = [&](InputState state) { return until([&] { return input.status().state == state; }); };
    const auto receives = [&](std::uint64_t packets) {
        return send(1, {42}) && until([&] { return input.status().packets == packets; });
    };
    ASSERT_TRUE(is(InputState::open));
    EXPECT_TRUE(receives(1));
    ASSERT_TRUE(run("ip link set locus0 down") && is(InputState::waiting));
    ASSERT_TRUE(run("ip link set locus0 up") && is(InputState::open));
    EXPECT_TRUE(receives(2));
    ASSERT_TRUE(remove() && is(InputState::waiting));
    ASSERT_TRUE(add() && is(InputState::open));
    EXPECT_TRUE(receives(3));
    EXPECT_EQ(input.status().reconnects, 2u);
}

} // namespace
} // namespace locus
