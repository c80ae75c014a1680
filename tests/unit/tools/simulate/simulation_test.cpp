// The simulation from scenario to bytes, and back through the decoders.
#include "tools/simulate/simulation.h"

#include "drivers/recording/log_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

namespace locus::simulate {
namespace {

std::string scenario_text(const std::string& sensors, const std::string& seed = "1") {
    return "simulation: {seed: " + seed + R"(}
site:
  anchors:
    - {name: A0, address: 0, position_site_m: [0, 0, 3]}
    - {name: A1, address: 1, position_site_m: [9, 0, 1]}
    - {name: A5, address: 5, position_site_m: [9, 9, 3]}
targets:
  - {name: one, address: 3, speed_mps: 2, waypoints_site_m: [[1, 1, 1], [8, 8, 1]]}
  - {name: two, address: 4, path: figure_of_eight, center_site_m: [4, 4, 1]}
sensors:
)" + sensors;
}

const std::string trek = "  - {name: uwb, transport: pty, path: x, decoder: trek1000, rate_hz: 10, sigma_m: 0}\n";
const std::string can = "  - {name: bus, transport: can, interface: vcan0, decoder: dw1000_can, "
                        "mode: range_differences, rate_hz: 20, sigma_m: 0, delay_s: 0.1}\n";
const std::string noisy = "  - {name: noisy, transport: fifo, path: y, decoder: trek1000, rate_hz: 10, loss: 0.2}\n";

constexpr Timestamp start = timestamp_from_ns(1'000'000'000);

Scenario load(const std::string& yaml) {
    auto result = load_scenario_text(yaml, "test");
    if (!result.scenario) throw std::runtime_error(to_string(result.problems.at(0)));
    return *result.scenario;
}

/// The recording of the sensor's first two seconds.
std::string record(const std::string& yaml, std::size_t sensor = 0) {
    const Scenario scenario = load(yaml);
    std::ostringstream stream;
    Simulation simulation(scenario, start);
    simulation.add_output(sensor, make_recorder(scenario.sensors[sensor].input, stream));
    while (simulation.next() < start + std::chrono::seconds{2}) simulation.step();
    return stream.str();
}

struct Sink : MeasurementSink {
    std::vector<Measurement> measurements;
    int refused = 0;
    void accept(Timestamp time, const Observation& observation) override {
        measurements.push_back({time, 0, 0, observation});
    }
    void refuse(Refusal) override { ++refused; }
};

std::vector<Measurement> decode(const std::string& recording, const InputSettings& input) {
    const auto decoder = input.decoder->make(input.decoder_settings.get());
    Sink sink;
    std::istringstream lines(recording);
    for (std::string line, error; std::getline(lines, line);) {
        const auto record = from_log_line(line, error);
        EXPECT_TRUE(record) << error;
        EXPECT_EQ(record->input, input.name);
        decoder->decode(record->packet(), sink);
    }
    EXPECT_EQ(sink.refused, 0);
    return sink.measurements;
}

double distance_m(const Scenario& scenario, Address anchor, Address tag, Timestamp sample) {
    const std::size_t mover = tag == address(3) ? 0 : 1;
    const auto at = Target(scenario.movers[mover].motion).at(to_s(sample - start)).position_site_m;
    return (at - Eigen::Vector3d{scenario.site.find_anchor(anchor)->position_site_m.data()}).norm();
}

TEST(Simulation, TrekLinesDecodeToTheTrueDistances) {
    const Scenario scenario = load(scenario_text(trek));
    const auto measurements = decode(record(scenario_text(trek)), scenario.sensors[0].input);
    ASSERT_EQ(measurements.size(), 2u * 10 * 2 * 3); // seconds, rate, targets, anchors
    for (const Measurement& measurement : measurements) {
        const auto& range = std::get<Range>(measurement.observation);
        const double truth_m = distance_m(scenario, range.anchor, range.tag, measurement.time);
        ASSERT_NEAR(range.range_m, truth_m, 1.1e-3); // the format's millimetres are cut off
    }
}

TEST(Simulation, CanFramesDecodeToTheTrueDifferencesOfTheirSampleTime) {
    const Scenario scenario = load(scenario_text(can));
    const auto measurements = decode(record(scenario_text(can)), scenario.sensors[0].input);
    ASSERT_EQ(measurements.size(), 2u * 38 * 3); // the first comes 0.1 s late
    for (const Measurement& measurement : measurements) {
        const auto& difference = std::get<RangeDifference>(measurement.observation);
        const Timestamp sample = measurement.time - std::chrono::milliseconds{100};
        const double truth_m = distance_m(scenario, difference.anchor_b, difference.tag, sample) -
                               distance_m(scenario, difference.anchor_a, difference.tag, sample);
        ASSERT_NEAR(difference.difference_m, truth_m, 0.6e-3);
    }
}

TEST(Simulation, SameSeedSameBytes) {
    const std::string first = record(scenario_text(noisy));
    EXPECT_FALSE(first.empty());
    EXPECT_EQ(record(scenario_text(noisy)), first);
    EXPECT_NE(record(scenario_text(noisy, "2")), first);
}

TEST(Simulation, OneMoreSensorDoesNotChangeTheOthers) {
    EXPECT_EQ(record(scenario_text(noisy + can)), record(scenario_text(noisy)));
}

TEST(Simulation, ADriftingClockChangesRateAndDeviceTime) {
    std::string fast = trek;
    fast.replace(fast.find("sigma_m: 0"), 10, "sigma_m: 0, clock_drift_ppm: 1000");
    const auto last_time = [](const std::string& recording) {
        const std::size_t last = recording.rfind('(');
        return std::stod(recording.substr(last + 1));
    };
    EXPECT_NEAR(last_time(record(scenario_text(trek))), 1 + 1.95, 1e-6);
    EXPECT_NEAR(last_time(record(scenario_text(fast))), 1 + 2.00 / 1.001, 1e-6);
}

TEST(Simulation, WritesTheTruthAtItsRate) {
    const Scenario scenario = load(scenario_text(trek));
    std::ostringstream truth;
    Simulation simulation(scenario, start);
    simulation.add_truth(0, 100, truth);
    while (simulation.next() < start + std::chrono::seconds{1}) simulation.step();
    std::istringstream lines(truth.str());
    int count = 0;
    for (double t, x, y, z, qx, qy, qz, qw; lines >> t >> x >> y >> z >> qx >> qy >> qz >> qw; ++count) {
        const auto pose = Target(scenario.movers[0].motion).at(t - 1);
        ASSERT_NEAR((Eigen::Vector3d{x, y, z} - pose.position_site_m).norm(), 0, 1e-5);
        ASSERT_NEAR(qz * qz + qw * qw, 1, 1e-6);
    }
    EXPECT_EQ(count, 100);
}

} // namespace
} // namespace locus::simulate
