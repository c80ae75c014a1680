// Driving a radio: who is asked, and when.
#include "drivers/uwb/pulson/requests.h"

#include "drivers/uwb/pulson/envelope.h"
#include "drivers/uwb/pulson/messages.h"
#include "drivers/uwb/pulson/pulson.h"
#include "drivers/uwb/pulson/radio_info.h"
#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>

namespace locus::uwb::pulson {
namespace {

using namespace std::chrono_literals;

constexpr Timestamp start{1h};

struct Driven {
    std::unique_ptr<Decoder> decoder;
    test::Collector sink;

    explicit Driven(const std::string& responders) {
        const PulsonSettings settings{.tag = address(18), .responders = responders, .request_timeout_s = 0.2};
        decoder = make_usb(&settings);
    }
    std::optional<RangeRequest> asks(Timestamp now) {
        const auto packet = decoder->request(now);
        return packet ? parse<RangeRequest>(UsbFormat::message(packet->data)) : std::nullopt;
    }
    template <class Message>
    void hears(const Message& message, Timestamp time = start) {
        decoder->decode(test::bytes_packet(UsbFormat::wrap(encode(message)), time), sink);
    }
};

TEST(PulsonRequests, GoRoundAndOneIsOutstanding) {
    Driven radio{"101, 0x66"};
    const auto first = radio.asks(start);
    ASSERT_TRUE(first);
    EXPECT_EQ(first->responder, 101u);
    EXPECT_EQ(first->antenna, 0xFF);
    EXPECT_EQ(first->data_size, 0);
    EXPECT_FALSE(radio.asks(start + 199ms));
    radio.hears(FullRange{.message = first->message, .responder = 101, .precise_mm = 1000, .parts = precise});
    const auto second = radio.asks(start + 20ms);
    ASSERT_TRUE(second);
    EXPECT_EQ(second->responder, 102u);
    EXPECT_NE(second->message, first->message);
    radio.hears(SmallRange{.message = second->message, .responder = 102, .status = timeout});
    EXPECT_EQ(radio.asks(start + 40ms)->responder, 101u);
    EXPECT_EQ(radio.sink.items.size(), 1u);
}

TEST(PulsonRequests, TheNextIsAskedWhenNoAnswerComes) {
    Driven radio{"101,102"};
    const auto first = radio.asks(start);
    const auto second = radio.asks(start + 200ms);
    EXPECT_EQ(second->responder, 102u);
    radio.hears(FullRange{.message = first->message});
    EXPECT_FALSE(radio.asks(start + 300ms)) << "a late answer is not that to the newest request";
}

TEST(PulsonRequests, WhatIsNoAnswerIsWaitedOut) {
    Driven radio{"101"};
    const auto message = radio.asks(start)->message;
    radio.hears(Confirm{.message = message, .status = 2});
    radio.hears(FullRange{.message = message, .status = coarse_update, .parts = coarse});
    EXPECT_FALSE(radio.asks(start + 100ms));
}

TEST(PulsonRequests, ALineOpenedAnewIsAskedAtOnce) {
    Driven radio{"101"};
    ASSERT_TRUE(radio.asks(start));
    radio.decoder->reset();
    EXPECT_TRUE(radio.asks(start + 1ms));
}

TEST(PulsonRequests, ARadioThatRangesByItselfIsGreetedWhenItIsSilent) {
    Driven radio{""};
    const auto greeted = [&](Timestamp now) {
        const auto packet = radio.decoder->request(now);
        return packet && parse<StatusRequest>(UsbFormat::message(packet->data));
    };
    EXPECT_TRUE(greeted(start));
    EXPECT_FALSE(greeted(start + 4999ms));
    EXPECT_TRUE(greeted(start + 5s));
    radio.hears(FullRange{}, start + 6s);
    EXPECT_FALSE(greeted(start + 10s));
    EXPECT_TRUE(greeted(start + 11s));
    radio.decoder->reset();
    EXPECT_TRUE(greeted(start + 12s)) << "the line was opened anew";
}

TEST(PulsonRequests, NobodyIsAskedUnlessTheSettingsSaySo) {
    EXPECT_FALSE(Driven{""}.asks(start));
    EXPECT_FALSE(Driven{"101,x"}.asks(start));
}

TEST(PulsonRequests, RespondersAreReadOrToldWhatIsWrong) {
    const auto complaint = [](const std::string& text) {
        const PulsonSettings settings{.responders = text};
        return check_pulson(&settings);
    };
    std::string error;
    EXPECT_EQ(parse_responders(" 101,0x66 , 103", error), (std::vector<std::uint32_t>{101, 102, 103}));
    EXPECT_TRUE(error.empty());
    for (const char* bad : {"x", "101,,102", "101 102", "-1", "0", "4294967295", "4294967296", "0x", "101;102"}) {
        EXPECT_NE(complaint(bad), "") << bad;
    }
    std::string many = "1";
    for (int i = 0; i < 64; ++i) many += ",1";
    EXPECT_EQ(complaint(many), "responders names more than 64 radios");
}

} // namespace
} // namespace locus::uwb::pulson
