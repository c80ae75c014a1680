// A receiver's time on the host's clock: with jitter, over the end of week and day, after restarts and wrong times.
#include "drivers/gnss/epoch_clock.h"

#include <gtest/gtest.h>

#include <random>

namespace locus::gnss {
namespace {

constexpr std::int64_t ms = 1'000'000, second = 1'000 * ms;

/// Epochs of a receiver, which come 30 ms later and up to 80 ms more; the host's clock runs 20 ppm fast.
class Stream {
  public:
    explicit Stream(std::int64_t begin_ns, std::int64_t period_ns = EpochClock::week_ns)
        : told_ns_{begin_ns}, period_ns_{period_ns}, clock_{period_ns} {}

    /// The farthest that an epoch is dated from its true time and 30 ms, from epoch `converged` on.
    double worst_ms(int epochs, std::int64_t step_ns, int converged = 0) {
        double worst = 0;
        for (int i = 0; i < epochs; ++i) {
            const double error = error_ms(step_ns);
            if (i >= converged) worst = std::max(worst, std::abs(error));
        }
        return worst;
    }

    double error_ms(std::int64_t step_ns) {
        true_s_ += static_cast<double>(step_ns) * 1e-9;
        told_ns_ = (told_ns_ + step_ns) % period_ns_;
        const Timestamp taken = timestamp_from_s(1000 + true_s_ * (1 + 20e-6) + 0.03);
        const Timestamp received = taken + Duration{static_cast<std::int64_t>(80 * ms * delay_(random_))};
        return to_s(clock_.host_time(told_ns_, received) - taken) * 1e3;
    }

    /// The receiver tells another time from now on.
    void set(std::int64_t told_ns) { told_ns_ = told_ns; }
    EpochClock& clock() { return clock_; }

  private:
    std::int64_t told_ns_, period_ns_;
    EpochClock clock_;
    double true_s_ = 0;
    std::mt19937 random_{20261122};
    std::uniform_real_distribution<double> delay_{0, 1};
};

TEST(EpochClock, JitterOfTheLineDoesNotEnter) {
    Stream stream{100 * second};
    EXPECT_GT(stream.worst_ms(5, 100 * ms), 10) << "the first epochs are as late as they came";
    EXPECT_LT(stream.worst_ms(3000, 100 * ms, 600), 3) << "after a minute the least delay is known";
    Stream slow{100 * second};
    EXPECT_LT(slow.worst_ms(3000, second, 120), 12) << "one epoch a second: 60 delays stand in the window";
}

TEST(EpochClock, TheWeekEndsAndNothingHappens) {
    Stream stream{EpochClock::week_ns - 90 * second};
    stream.worst_ms(600, 100 * ms);
    EXPECT_LT(stream.worst_ms(600, 100 * ms), 3);
}

TEST(EpochClock, TheDayEndsAlsoWithALeapSecond) {
    Stream plain{EpochClock::day_ns - 90 * second, EpochClock::day_ns};
    plain.worst_ms(600, 100 * ms);
    EXPECT_LT(plain.worst_ms(600, 100 * ms), 3);
    EpochClock clock{EpochClock::day_ns};
    for (int i = -120; i < 120; ++i) { // 23:59:59, 23:59:60, 00:00:00
        const std::int64_t told_s = i <= 0 ? 86400 + i : i - 1;
        const Timestamp received = timestamp_from_s(5000 + i);
        EXPECT_EQ(clock.host_time(told_s * second, received), received) << i;
    }
}

TEST(EpochClock, AReceiverThatSetsItsTimeIsFollowedAtOnce) {
    Stream stream{0};
    for (const std::int64_t wrong : {3 * 86400 * second, 18 * second, 500'000 * second, 2 * second, 0 * second}) {
        stream.set(wrong);
        EXPECT_LT(stream.worst_ms(5, second), 81) << "no later than it came";
    }
    stream.worst_ms(600, 100 * ms);
    EXPECT_LT(stream.worst_ms(600, 100 * ms), 3) << "and nothing of it stays";
}

TEST(EpochClock, ALeapSecondThatIsNotToldCostsNoEpoch) {
    EpochClock clock{EpochClock::day_ns};
    for (int i = -120; i < 120; ++i) { // 23:59:59, 00:00:00, 00:00:00
        const std::int64_t told_s = (i <= 0 ? 86400 + i : i - 1) % 86400;
        const Timestamp received = timestamp_from_s(5000 + i);
        EXPECT_EQ(clock.host_time(told_s * second, received), received) << i;
    }
}

TEST(EpochClock, SmallStepsAreFoundToo) {
    for (const std::int64_t step : {-300 * ms, 300 * ms}) {
        Stream stream{1000 * second};
        stream.worst_ms(600, 100 * ms);
        stream.set(1060 * second + step);
        stream.worst_ms(60, 100 * ms); // some of them wrong by the step
        stream.worst_ms(600, 100 * ms);
        EXPECT_LT(stream.worst_ms(300, 100 * ms), 3) << step;
    }
}

TEST(EpochClock, TwoTimesOfOneEpochStayApartByTheirDifference) {
    EpochClock clock{EpochClock::week_ns};
    for (int i = 0; i < 300; ++i) {
        const Timestamp received = timestamp_from_s(100 + 0.25 * i);
        const std::int64_t epoch = 250 * ms * i + second;
        const Timestamp fix = clock.host_time(epoch, received);
        const Timestamp raw = clock.host_time(epoch - 2 * ms, received + std::chrono::milliseconds{5});
        ASSERT_EQ(fix - raw, std::chrono::milliseconds{2}) << i;
        ASSERT_EQ(fix, received) << i << ": it does not begin anew";
    }
}

TEST(EpochClock, OpenedAgainItBeginsAnew) {
    Stream stream{0};
    stream.worst_ms(600, 100 * ms);
    stream.clock().reset();
    EXPECT_GT(stream.worst_ms(20, 100 * ms), 5);
}

} // namespace
} // namespace locus::gnss
