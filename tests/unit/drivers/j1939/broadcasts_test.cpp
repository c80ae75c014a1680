// J1939 identifiers, and messages that come in pieces: whole or refused, and the next one whole again.
#include "drivers/j1939/broadcasts.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <map>

namespace locus::j1939 {
namespace {

using namespace std::chrono_literals;
using Bytes = std::vector<std::uint8_t>;
using Outcome = Broadcasts::Outcome;

TEST(J1939Identifier, OfTheVendorsFrames) {
    EXPECT_EQ(identifier(0x18EF8001 | CAN_EFF_FLAG), (Identifier{6, 0xEF00, 0x01, 0x80}));
    EXPECT_EQ(identifier(0x10ECFF80 | CAN_EFF_FLAG), (Identifier{4, 0xEC00, 0x80, everyone}));
    EXPECT_EQ(identifier(0x18FEF117 | CAN_EFF_FLAG), (Identifier{6, 0xFEF1, 0x17, everyone})) << "65265, to everyone";
    for (const std::uint32_t id : {0x123u, 0x18EF8001 | CAN_EFF_FLAG | CAN_RTR_FLAG, CAN_ERR_FLAG | CAN_EFF_FLAG})
        EXPECT_FALSE(identifier(id));
}

TEST(J1939Identifier, ComesBackAsItWent) {
    EXPECT_TRUE(rc::check([] {
        const std::uint32_t id = *rc::gen::inRange(0u, CAN_EFF_MASK + 1) | CAN_EFF_FLAG;
        RC_ASSERT(can_id(identifier(id).value()) == id);
    }));
}

struct Receiver {
    Broadcasts broadcasts{};
    std::vector<std::pair<int, Bytes>> messages{}; ///< source, data
    int refused = 0;
    Timestamp now{1h};

    Outcome hears(const CanFrame& frame, Duration later = 50ms) {
        now += later;
        const auto id = identifier(frame.id);
        const Outcome outcome = id ? broadcasts.take(*id, frame.packet(now)) : Outcome::nothing;
        if (outcome == Outcome::refused) ++refused;
        if (outcome == Outcome::whole) {
            const Message message = broadcasts.message();
            messages.push_back({message.source, {message.data.begin(), message.data.end()}});
        }
        return outcome;
    }
    void hears(const std::vector<CanFrame>& frames) {
        for (const CanFrame& frame : frames) hears(frame);
    }
};

Bytes any_data() {
    const auto size = *rc::gen::oneOf(rc::gen::inRange<std::size_t>(9, 60), rc::gen::inRange<std::size_t>(9, 1786));
    return *rc::gen::container<Bytes>(size, rc::gen::arbitrary<std::uint8_t>());
}

Bytes counted(std::size_t size) {
    Bytes data(size);
    for (std::size_t i = 0; i < size; ++i) data[i] = static_cast<std::uint8_t>(i);
    return data;
}

TEST(J1939Broadcasts, SplitAndPutTogether) {
    EXPECT_TRUE(rc::check([] {
        const Bytes data = any_data();
        const auto group = *rc::gen::inRange(0u, 0x40000u);
        Receiver receiver;
        receiver.hears(broadcast(group, 0x80, data));
        RC_ASSERT(receiver.messages == (std::vector{std::pair{0x80, data}}));
        RC_ASSERT(receiver.broadcasts.message().group == group);
        RC_ASSERT(receiver.refused == 0);
    }));
}

TEST(J1939Broadcasts, AMessageIsDatedByItsAnnouncement) {
    Receiver receiver;
    receiver.hears(broadcast(0xEF01, 0x80, counted(20)));
    EXPECT_EQ(receiver.broadcasts.message().begun, Timestamp{1h} + 50ms);
}

TEST(J1939Broadcasts, SourcesMayInterleave) {
    EXPECT_TRUE(rc::check([] {
        std::map<int, Bytes> sent;
        std::map<int, std::vector<CanFrame>> queues;
        for (std::uint8_t source = 0; source < Broadcasts::most_sources; ++source) {
            sent[source] = any_data();
            queues[source] = broadcast(0xEF01, source, sent[source]);
        }
        Receiver receiver;
        while (!queues.empty()) {
            auto queue = std::next(queues.begin(), *rc::gen::inRange<std::ptrdiff_t>(0, std::ssize(queues)));
            receiver.hears(queue->second.front(), 0ms);
            queue->second.erase(queue->second.begin());
            if (queue->second.empty()) queues.erase(queue);
        }
        RC_ASSERT((std::map<int, Bytes>{receiver.messages.begin(), receiver.messages.end()}) == sent);
        RC_ASSERT(receiver.refused == 0);
    }));
}

/// A damaged message, then an intact one: the first is refused and not given, the second is given.
void expect_only_the_second(const std::vector<CanFrame>& damaged, int refused = 1) {
    Receiver receiver;
    receiver.hears(damaged);
    const Bytes next = counted(30);
    receiver.hears(broadcast(0xEF01, 0x80, next));
    ASSERT_EQ(receiver.messages, (std::vector{std::pair{0x80, next}}));
    EXPECT_EQ(receiver.refused, refused);
}

TEST(J1939Broadcasts, ALostFrameCostsItsMessageAlone) {
    const auto frames = broadcast(0xEF01, 0x80, counted(52));
    for (std::size_t i = 0; i < frames.size(); ++i) {
        auto damaged = frames;
        damaged.erase(damaged.begin() + static_cast<std::ptrdiff_t>(i));
        expect_only_the_second(damaged);
    }
}

TEST(J1939Broadcasts, ADoubledFrameCostsItsMessageAlone) {
    const auto frames = broadcast(0xEF01, 0x80, counted(52));
    for (std::size_t i = 1; i + 1 < frames.size(); ++i) { // the last one doubled comes after the message
        auto damaged = frames;
        damaged.insert(damaged.begin() + static_cast<std::ptrdiff_t>(i), frames[i]);
        expect_only_the_second(damaged);
    }
}

TEST(J1939Broadcasts, SwappedFramesCostTheirMessageAlone) {
    const auto frames = broadcast(0xEF01, 0x80, counted(52));
    for (std::size_t i = 1; i + 1 < frames.size(); ++i) {
        auto damaged = frames;
        std::swap(damaged[i], damaged[i + 1]);
        expect_only_the_second(damaged, i == 1 ? 2 : 1); // a late number 1 looks like a lost announcement
    }
}

TEST(J1939Broadcasts, APauseThatIsTooLongEndsTheMessage) {
    const auto frames = broadcast(0xEF01, 0x80, counted(20));
    Receiver receiver;
    receiver.hears(frames[0]);
    EXPECT_EQ(receiver.hears(frames[1], 750ms), Outcome::kept);
    EXPECT_EQ(receiver.hears(frames[2], 751ms), Outcome::refused);
    EXPECT_EQ(receiver.hears(frames[3]), Outcome::nothing);
}

TEST(J1939Broadcasts, AnAnnouncementIsNotBelieved) {
    const auto announced = [](std::uint16_t size, std::uint8_t frames, std::uint8_t length = 8) {
        const CanFrame frame{
            can_id({7, announcements, 0x80, everyone}),
            length,
            {0x20, static_cast<std::uint8_t>(size), static_cast<std::uint8_t>(size >> 8), frames, 0xFF, 1, 0xEF, 0}};
        return Receiver{}.hears(frame);
    };
    EXPECT_EQ(announced(1785, 255), Outcome::kept);
    EXPECT_EQ(announced(9, 2), Outcome::kept);
    const std::vector<std::pair<int, int>> bad{{8, 2}, {0, 0}, {1786, 255}, {1786, 0}, {65535, 255}, {20, 2}, {20, 4}};
    for (const auto& [size, frames] : bad)
        EXPECT_EQ(announced(static_cast<std::uint16_t>(size), static_cast<std::uint8_t>(frames)), Outcome::refused);
    EXPECT_EQ(announced(9, 2, 7), Outcome::refused);
}

TEST(J1939Broadcasts, MoreSourcesThanThereIsRoomForCostTheLongestSilent) {
    Receiver receiver;
    for (std::uint8_t source = 0; source <= Broadcasts::most_sources; ++source)
        receiver.hears(broadcast(0xEF01, source, counted(9))[0]);
    EXPECT_EQ(receiver.refused, 1);
    EXPECT_EQ(receiver.hears(broadcast(0xEF01, 1, counted(9))[1]), Outcome::kept);
}

TEST(J1939Broadcasts, TransfersBetweenTwoAreNotLookedAt) {
    Receiver receiver;
    CanFrame to_one = broadcast(0xEF01, 0x80, counted(9))[0];
    to_one.id = can_id({7, announcements, 0x80, 0x01});
    EXPECT_EQ(receiver.hears(to_one), Outcome::nothing);
    CanFrame other_control = broadcast(0xEF01, 0x80, counted(9))[0];
    other_control.data[0] = 0xFF;
    EXPECT_EQ(receiver.hears(other_control), Outcome::nothing);
}

} // namespace
} // namespace locus::j1939
