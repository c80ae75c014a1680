// After construction the engine allocates nothing, whatever is thrown at it.
#include "tests/allocations.h"
#include "tests/unit/fusion/engine_fixture.h"

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <random>

namespace locus::engine_test {
namespace {

TEST(AllocationCount, SeesOperatorNewAndEigen) {
    const test::AllocationCount count;
    auto number = std::make_unique<int>(1);
    EXPECT_EQ(count.made(), 1u);
    Eigen::VectorXd vector = Eigen::VectorXd::Zero(40 + *number);
    EXPECT_EQ(count.made(), 2u);
    EXPECT_EQ(vector.sum(), 0);
}

Measurement random_measurement(std::mt19937& random, double now_s, std::uint32_t sequence) {
    const auto pick = [&](std::uint32_t n) { return static_cast<double>(random() % n); };
    const auto tag = static_cast<std::uint64_t>(90 + pick(20)); // more than there is room for
    const auto anchor = static_cast<std::uint64_t>(pick(6));    // two of them strangers
    auto measurement = range(now_s - 0.001 * pick(300), pick(50), sequence, anchor, tag);
    if (sequence % 7 == 0) measurement.observation = PeerRange{address(tag), address(tag + 1), 3, unknown_f};
    if (sequence % 11 == 0) measurement.observation = Range{address(anchor), address(tag), std::nan("")};
    if (sequence % 13 == 0) measurement.observation = SignalStrength{address(sequence), address(tag), -60};
    if (sequence % 3 == 0) measurement.observation = ImuSample{address(tag), {0.1, 0, 9.8}, {0, 0, 0.1}};
    if (sequence % 23 == 0) measurement.observation = Height{address(tag), 1.5, unknown_f};
    if (sequence % 29 == 0) measurement.observation = WheelSpeed{address(tag), 1.5};
    if (sequence % 17 == 0) measurement.time = at(now_s + 1);
    return measurement;
}

std::uint64_t allocations_of_a_run(EngineSettings settings) {
    Engine engine(std::move(settings));
    std::mt19937 random(7);
    std::uint32_t sequence = 0;
    const test::AllocationCount count;
    for (int tick = 1; tick <= 1000; ++tick) {
        const double now_s = 0.01 * tick;
        for (int i = 0; i < 40; ++i) {
            const auto measurement = random_measurement(random, now_s, ++sequence);
            engine.submit(measurement, at(now_s));
            if (sequence % 19 == 0) engine.submit(measurement, at(now_s));
        }
        engine.step(at(now_s));
        if (tick % 300 == 0) sequence += 1000;
    }
    const auto made = count.made();
    const auto& total = engine.counters();
    for (const auto reason :
         {Exclusion::none, Exclusion::late, Exclusion::duplicate, Exclusion::not_finite, Exclusion::unknown_target,
          Exclusion::unknown_source, Exclusion::stamp_in_future, Exclusion::window_full})
        EXPECT_GT(total.by_reason[static_cast<std::size_t>(reason)], 0u) << exclusion_name(reason);
    EXPECT_GT(total.rolled_back, 500u);
    return made;
}

TEST(Engine, AllocatesNothingAfterConstruction) {
    for (const char* estimator :
         {"follower", "range_ekf", "inertial_ekf", "chan_taylor", "kalman", "coloured_kalman", "pca_kalman"}) {
        auto settings = follower_settings();
        settings.fusion.estimator = estimator;
        settings.fusion.smooth_lag_s = 0.1;
        settings.fusion.max_targets = 12;
        settings.fusion.max_measurement_rate_hz = 20;
        EXPECT_EQ(allocations_of_a_run(settings), 0u) << estimator;
    }
}

} // namespace
} // namespace locus::engine_test
