// From the lines that four listeners print to the position of the tag that they heard: decoder, clock synchronisation,
// engine.
#include "drivers/uwb/listener_json.h"
#include "fusion/engine.h"
#include "tests/unit/drivers/collector.h"
#include "tests/unit/fusion/uwb/clock_sync/simulated_clocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace locus::uwb {
namespace {

using clock_test::Message;
using clock_test::SimulatedAnchors;

ListenerReport report_of(std::uint64_t received_ticks, const std::vector<std::uint8_t>& frame) {
    ListenerReport report;
    report.received_ticks = received_ticks;
    for (const std::uint8_t byte : frame) report.frame.emplace_back() = byte;
    return report;
}

/// The anchor that heard it, and the line that it prints.
std::pair<Address, std::string> line_of(const Observation& observation) {
    if (const auto* arrival = std::get_if<Arrival>(&observation)) {
        const ieee802154::Blink blink{static_cast<std::uint8_t>(arrival->sequence), number(arrival->tag)};
        return {arrival->anchor, encode(report_of(arrival->rx_anchor_ticks_in_anchor, encode(blink)))};
    }
    const auto& sync = std::get<ClockSync>(observation);
    ieee802154::ClockCalibration packet;
    packet.sequence = static_cast<std::uint8_t>(sync.sequence);
    packet.eui = number(sync.transmitter);
    packet.sent_ticks_in_master = sync.tx_transmitter_ticks_in_transmitter;
    return {sync.receiver, encode(report_of(sync.rx_receiver_ticks_in_receiver, encode(packet)))};
}

TEST(ListenerClocks, LinesOfFourListenersGiveThePositionOfATag) {
    SimulatedAnchors world(21);
    world.place({{0, 0, 4}, {20, 0, 0.5}, {20, 12, 4}, {0, 12, 0.5}});
    world.everyone_hears(0);
    world.air.blink_interval_s = 0.1;
    world.tag_position = [](double t) {
        return Eigen::Vector3d(10 + 3 * std::cos(t / 3), 6 + 2 * std::sin(t / 3), 1.2);
    };

    EngineSettings settings;
    settings.site = world.site;
    Engine engine(settings);
    std::vector<std::unique_ptr<Decoder>> listeners;
    for (const Anchor& anchor : world.site.anchors) {
        const ListenerSettings own{anchor.address};
        listeners.push_back(make_listener_json(&own));
    }
    std::uint32_t sequence = 0;
    world.send = [&](const Message& message) {
        const auto [anchor, line] = line_of(message.measurement.observation);
        test::Collector sink;
        listeners[number(anchor)]->decode(test::bytes_packet(line, message.measurement.time), sink);
        ASSERT_EQ(sink.items.size(), 1u);
        engine.submit(
            {sink.items[0].time, sequence++, static_cast<std::uint16_t>(number(anchor)), sink.items[0].observation},
            message.measurement.time);
    };
    double squares_m2 = 0;
    int poses = 0;
    while (world.time_s() < 12) {
        world.step();
        if (std::llround(world.time_s() / clock_test::step_s) % 10 != 0) continue;
        for (const Pose& pose : engine.step(timestamp_from_s(100 + world.time_s()))) {
            if (world.time_s() < 4 || pose.estimate.missing != Missing::nothing) continue;
            const Eigen::Vector3d off = vector(pose.estimate.position_site_m) - world.tag_position(world.time_s());
            squares_m2 += off.head<2>().squaredNorm();
            ++poses;
        }
    }
    EXPECT_GT(poses, 790);
    EXPECT_LT(std::sqrt(squares_m2 / poses), 0.15);
}

} // namespace
} // namespace locus::uwb
