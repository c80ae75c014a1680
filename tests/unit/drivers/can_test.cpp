// The parts of the CAN transport that need no CAN: frames, filters, error frames, stamps.
#include "drivers/clock.h"
#include "drivers/transport/can_filter.h"
#include "drivers/transport/can_frame.h"
#include "drivers/transport/can_health.h"
#include "drivers/transport/receive_stamps.h"
#include "tests/unit/drivers/transport_fixture.h"

#include <gmock/gmock.h>
#include <linux/can/error.h>
#include <linux/errqueue.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <cstring>

namespace locus {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using Bytes = std::vector<std::uint8_t>;

TEST(CanFrame, ByteCountTellsClassicFromFd) {
    canfd_frame frame{};
    frame.can_id = 0x123;
    frame.len = 3;
    frame.flags = CANFD_BRS | CANFD_FDF;
    frame.data[2] = 7;
    const auto classic = packet_from_can(frame, CAN_MTU);
    ASSERT_TRUE(classic);
    EXPECT_FALSE(classic->can_fd);
    EXPECT_EQ(classic->data.size(), 3u);
    EXPECT_EQ(classic->data[2], 7);
    const auto fd = packet_from_can(frame, CANFD_MTU);
    ASSERT_TRUE(fd);
    EXPECT_TRUE(fd->can_fd);
    EXPECT_EQ(fd->can_fd_flags, CANFD_BRS) << "the kernel's own mark is not passed on";
}

TEST(CanFrame, LengthsInTheFrameAreNotTrusted) {
    canfd_frame frame{};
    frame.len = 9;
    EXPECT_FALSE(packet_from_can(frame, CAN_MTU));
    EXPECT_TRUE(packet_from_can(frame, CANFD_MTU));
    frame.len = 65;
    EXPECT_FALSE(packet_from_can(frame, CANFD_MTU));
    frame.len = 0;
    for (const std::size_t size : {0, 1, 15, 17, 71, 73}) EXPECT_FALSE(packet_from_can(frame, size)) << size;
}

TEST(CanFrame, ARemoteFrameHasNoData) {
    canfd_frame frame{};
    frame.can_id = 0x7DF | CAN_RTR_FLAG;
    frame.len = 8;
    EXPECT_TRUE(packet_from_can(frame, CAN_MTU)->data.empty());
}

RC_GTEST_PROP(CanFrameProperty, WhatIsSentIsReceived, ()) {
    Packet packet;
    packet.wire = Wire::can;
    packet.can_fd = *rc::gen::arbitrary<bool>();
    packet.can_id = *rc::gen::inRange(0u, CAN_EFF_MASK + 1) | CAN_EFF_FLAG;
    const auto data =
        *rc::gen::container<Bytes>(*rc::gen::inRange(0, packet.can_fd ? 65 : 9), rc::gen::arbitrary<std::uint8_t>());
    packet.data = data;
    const auto sent = can_from_packet(packet);
    RC_ASSERT(sent.has_value());
    const auto back = packet_from_can(sent->frame, sent->size);
    RC_ASSERT(back.has_value());
    RC_ASSERT(back->can_id == packet.can_id);
    RC_ASSERT(back->can_fd == packet.can_fd);
    RC_ASSERT(back->data.size() >= data.size());
    for (std::size_t i = 0; i < back->data.size(); ++i) RC_ASSERT(back->data[i] == (i < data.size() ? data[i] : 0));
}

TEST(CanFrame, TooMuchDataIsNotSent) {
    const Bytes nine(9), sixty_five(65), thirteen(13);
    EXPECT_FALSE(can_from_packet({.wire = Wire::can, .data = nine}));
    EXPECT_FALSE(can_from_packet({.wire = Wire::can, .can_fd = true, .data = sixty_five}));
    EXPECT_EQ(can_from_packet({.wire = Wire::can, .can_fd = true, .data = thirteen})->frame.len, 16);
}

bool passes(const can_filter& filter, canid_t id) {
    return (id & filter.can_mask) == (filter.can_id & filter.can_mask);
}

TEST(CanFilter, ExactIdsAndMasks) {
    std::string error;
    const auto filters = parse_can_filters("123,200:7F0,18FF1234", error);
    ASSERT_EQ(filters.size(), 3u) << error;
    EXPECT_TRUE(passes(filters[0], 0x123));
    EXPECT_FALSE(passes(filters[0], 0x124));
    EXPECT_FALSE(passes(filters[0], 0x123 | CAN_EFF_FLAG)) << "an extended id with the same low bits is another one";
    EXPECT_FALSE(passes(filters[0], 0x123 | CAN_RTR_FLAG));
    EXPECT_TRUE(passes(filters[1], 0x20F));
    EXPECT_FALSE(passes(filters[1], 0x210));
    EXPECT_TRUE(passes(filters[2], 0x18FF1234 | CAN_EFF_FLAG));
    EXPECT_TRUE(parse_can_filters("", error).empty());
    EXPECT_EQ(error, "");
}

TEST(CanFilter, SaysWhichOneIsWrong) {
    for (const std::string bad : {"12", "123:", "123:FFF", "8FF", "123 ", "20000004", "123,,124"}) {
        std::string error;
        EXPECT_TRUE(parse_can_filters(bad, error).empty()) << bad;
        EXPECT_THAT(error, HasSubstr("filter")) << bad;
    }
}

void take(CanHealth& health, std::uint32_t what, std::uint8_t controller = 0) {
    const Bytes data{0, controller, 0, 0, 0, 0, 0, 0};
    health.take({.wire = Wire::can, .can_id = CAN_ERR_FLAG | what, .data = data});
}

TEST(CanHealth, FollowsTheController) {
    CanHealth health{"can0"};
    EXPECT_EQ(health.trouble(), "");
    take(health, CAN_ERR_CRTL, CAN_ERR_CRTL_RX_WARNING);
    EXPECT_THAT(std::string{health.trouble()}, HasSubstr("can0 sees many errors"));
    take(health, CAN_ERR_CRTL, CAN_ERR_CRTL_TX_PASSIVE);
    EXPECT_THAT(std::string{health.trouble()}, HasSubstr("error passive"));
    take(health, CAN_ERR_CRTL, CAN_ERR_CRTL_ACTIVE);
    EXPECT_EQ(health.trouble(), "");
    EXPECT_EQ(health.error_frames(), 3u);
}

TEST(CanHealth, BusOffUntilRestarted) {
    CanHealth health{"can0"};
    take(health, CAN_ERR_BUSOFF);
    EXPECT_TRUE(health.bus_off());
    EXPECT_THAT(std::string{health.trouble()}, HasSubstr("bus-off"));
    take(health, CAN_ERR_RESTARTED);
    EXPECT_FALSE(health.bus_off());
    EXPECT_EQ(health.trouble(), "");
}

TEST(CanHealth, AShortErrorFrameIsNoAccident) {
    CanHealth health{"can0"};
    health.take({.wire = Wire::can, .can_id = CAN_ERR_FLAG | CAN_ERR_CRTL, .data = {}});
    EXPECT_EQ(health.error_frames(), 1u);
    EXPECT_EQ(health.trouble(), "");
}

/// A received message with control data, built as the kernel builds it.
class Control {
  public:
    template <class Content>
    Control& add(int type, const Content& content) {
        auto* header = reinterpret_cast<cmsghdr*>(buffer_ + used_);
        header->cmsg_level = SOL_SOCKET;
        header->cmsg_type = type;
        header->cmsg_len = CMSG_LEN(sizeof content);
        std::memcpy(CMSG_DATA(header), &content, sizeof content);
        used_ += CMSG_SPACE(sizeof content);
        return *this;
    }
    ControlData read() {
        msghdr message{};
        message.msg_control = buffer_;
        message.msg_controllen = used_;
        return read_control(message);
    }

  private:
    alignas(cmsghdr) unsigned char buffer_[256]{};
    std::size_t used_ = 0;
};

TEST(CanStamps, ReadsWhatTheKernelGave) {
    scm_timestamping stamps{};
    stamps.ts[0] = {1'700'000'000, 123'456'789};
    stamps.ts[2] = {42, 5};
    const ControlData data = Control{}.add(SO_RXQ_OVFL, std::uint32_t{17}).add(SCM_TIMESTAMPING, stamps).read();
    EXPECT_EQ(data.kernel_realtime, Duration{1'700'000'000'123'456'789});
    EXPECT_EQ(data.adapter, Duration{42'000'000'005});
    EXPECT_EQ(data.dropped, 17u);
}

TEST(CanStamps, NoStampIsNone) {
    EXPECT_FALSE(Control{}.read().kernel_realtime);
    const ControlData zeros = Control{}.add(SCM_TIMESTAMPING, scm_timestamping{}).read();
    EXPECT_FALSE(zeros.kernel_realtime || zeros.adapter || zeros.dropped);
    scm_timestamping insane{};
    insane.ts[2] = {std::numeric_limits<time_t>::max(), 0};
    EXPECT_FALSE(Control{}.add(SCM_TIMESTAMPING, insane).read().adapter);
}

TEST(CanStamps, OffsetTurnsWallClockIntoMonotonic) {
    const Timestamp converted{read_clock(CLOCK_REALTIME).time_since_epoch() - realtime_offset()};
    EXPECT_LT(std::chrono::abs(converted - monotonic_now()), 1s);
}

TEST(AdapterClock, RemovesTheDelayOfTheKernelAndFollowsDrift) {
    // 50 ppm fast, epoch far away, delays of 0.02 to 2 ms.
    AdapterClock clock;
    Duration worst{0};
    for (std::int64_t i = 0; i < 20'000; ++i) {
        const Timestamp truth = timestamp_from_ns(5'000'000'000 + i * 1'000'000);
        const Duration adapter{9'000'000'000'000 + i * 1'000'050};
        const Timestamp kernel = truth + Duration{20'000 + (i * 7919) % 1'980'000};
        const Timestamp time = clock.to_monotonic(adapter, kernel);
        ASSERT_LE(time, kernel);
        if (i >= 1000) worst = std::max(worst, Duration{std::chrono::abs(time - truth)});
    }
    EXPECT_LT(worst, 150us);
}

TEST(AdapterClock, StartsAnewWhenTheAdapterDid) {
    AdapterClock clock;
    for (int i = 0; i < 10; ++i) clock.to_monotonic(1000s + i * 1ms, timestamp_from_ns(5'000'000'000) + i * 1ms);
    const Timestamp kernel = timestamp_from_ns(6'000'000'000);
    EXPECT_EQ(clock.to_monotonic(3s, kernel), kernel);
    EXPECT_EQ(clock.to_monotonic(3s + 1ms, kernel + 2ms), kernel + 1ms);
}

TEST(Can, SaysWhatIsMissing) {
    const auto can = testing_transport::make_transport("can", {{"interface", "nocan7"}});
    EXPECT_FALSE(can->open());
    EXPECT_THAT(std::string{can->last_error()}, testing::AnyOf(HasSubstr("SocketCAN"), HasSubstr("nocan7")));
    const auto filtered = testing_transport::make_transport("can", {{"interface", "can0"}, {"filter", "12"}});
    EXPECT_FALSE(filtered->open());
    EXPECT_THAT(std::string{filtered->last_error()}, HasSubstr("filter"));
}

TEST(ReceiveStamps, TheKernelsStampUnlessItIsImpossible) {
    const Timestamp now{100s};
    const auto with = [](Duration realtime) { return ControlData{realtime, {}, {}}; };
    EXPECT_EQ(kernel_time(with(1099s), 1000s, now), Timestamp{99s});
    EXPECT_EQ(kernel_time(with(1101s), 1000s, now), now) << "in the future";
    EXPECT_EQ(kernel_time(with(1094s), 1000s, now), now) << "somebody set the clock";
    EXPECT_EQ(kernel_time({}, 1000s, now), now);
}

TEST(ReceiveStamps, DropsAreCountedOverSocketsAndWraps) {
    const auto dropped = [](std::uint32_t count) { return ControlData{{}, {}, count}; };
    KernelDrops drops;
    drops.take(dropped(0xFFFFFFFF));
    drops.take(dropped(1));
    drops.take({});
    EXPECT_EQ(drops.total(), 0x100000001u);
    drops.reset();
    drops.take(dropped(2));
    EXPECT_EQ(drops.total(), 0x100000003u);
}

} // namespace
} // namespace locus
