// The frames of protocols.md E-5.
#include "drivers/vehicle/obd2.h"

#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace locus::vehicle {
namespace {

using namespace std::chrono_literals;

struct Socket {
    explicit Socket(Obd2Settings settings = {}) {
        settings.tag = address(5);
        decoder = make_obd2(&settings);
    }
    void hear(const CanFrame& frame) { decoder->decode(frame.packet({}), sink); }
    std::unique_ptr<Decoder> decoder;
    test::Collector sink;
};

TEST(Obd2, SpeedAndPressure) {
    Socket car;
    car.hear({0x7E8, 8, {0x03, 0x41, 0x0D, 0x24}});
    car.hear({0x7E8, 8, {0x03, 0x41, 0x33, 0x65}});
    ASSERT_EQ(car.sink.items.size(), 2u);
    EXPECT_DOUBLE_EQ(std::get<WheelSpeed>(car.sink.items[0].observation).speed_mps, 10);
    EXPECT_EQ(std::get<WheelSpeed>(car.sink.items[0].observation).tag, address(5));
    EXPECT_EQ(std::get<Pressure>(car.sink.items[1].observation).pressure_pa, 101'000);
}

TEST(Obd2, AsksInTurnAndNotTooOften) {
    Socket car;
    const auto first = car.decoder->request(Timestamp{10s});
    ASSERT_TRUE(first);
    EXPECT_EQ(first->can_id, 0x7DFu);
    EXPECT_EQ(first->data[2], 0x0D);
    EXPECT_FALSE(car.decoder->request(Timestamp{10s + 99ms}));
    int pressures = 0;
    for (int i = 1; i < 20; ++i) pressures += car.decoder->request(Timestamp{10s + i * 100ms})->data[2] == 0x33;
    EXPECT_EQ(pressures, 2);
}

TEST(Obd2, ListensOnlyWhenToldTo) {
    Obd2Settings settings;
    settings.listen_only = true;
    EXPECT_FALSE(Socket{settings}.decoder->request(Timestamp{10s}));
}

TEST(Obd2, ARefusalByTheCarIsNone) {
    Socket car;
    car.hear({0x7E8, 8, {0x03, 0x7F, 0x01, 0x12}});
    car.hear({0x7E8, 3, {0x03, 0x41, 0x0D}});
    car.hear({0x7E8, 8, {0x10, 0x14, 0x49, 0x02}}); // first frame of a long answer
    car.hear({0x123, 8, {0x03, 0x41, 0x0D, 0x24}});
    EXPECT_TRUE(car.sink.items.empty());
    EXPECT_EQ(car.sink.refusals, (std::vector{Refusal::unknown_type, Refusal::malformed, Refusal::malformed}));
}

TEST(Obd2, WhatIsEncodedIsDecoded) {
    rc::check([](std::uint8_t kmh) {
        Socket car;
        car.hear(obd2_answer(Pid::speed, kmh, 0x7E8 + *rc::gen::inRange(0u, 8u)));
        RC_ASSERT(car.sink.all<WheelSpeed>().at(0).speed_mps == kmh / 3.6);
    });
}

} // namespace
} // namespace locus::vehicle
