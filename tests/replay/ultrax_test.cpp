// Raw stamps of real DW1000s become the ranges of somebody who walks between anchors. Every question is also the third
// packet of the exchange before it, so the double-sided formula applies, with replies of 1 and 77 ms.
#include "tests/replay/ultrax.h"

#include <gtest/gtest.h>

#include <cmath>

namespace locus::ultrax {
namespace {

using uwb::TimeOfFlight;

struct Sample {
    double time_s, range_m;
};

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// How much faster the anchor's clock runs, from two questions by either clock.
double rate_between(const Row& one, const Row& next) {
    const uwb::WrappingClock clock;
    const auto in_anchor = clock.since(next.exchange.poll_rx_ticks_in_b, one.exchange.poll_rx_ticks_in_b);
    const auto in_tag = clock.since(next.exchange.poll_tx_ticks_in_a, one.exchange.poll_tx_ticks_in_a);
    return static_cast<double>(in_anchor - in_tag) / static_cast<double>(in_tag);
}

/// From the exchange `one` and the question of `next`.
std::optional<TimeOfFlight> double_sided(const Row& one, const Row& next) {
    return uwb::double_sided({one.exchange, next.exchange.poll_tx_ticks_in_a, next.exchange.poll_rx_ticks_in_b});
}

class UltraxWalk : public ::testing::Test {
  protected:
    void SetUp() override {
        const auto file = test::recorded("ultrax_dw1000_raw/mjerenje-hodanje-L/UWB.CSV");
        if (!file) GTEST_SKIP() << "the walk of ultrax_dw1000_raw is not here (LOCUS_DATA)";
        walk = read_walk(*file);
    }

    std::vector<Sample> double_sided_ranges(unsigned anchor) const {
        const auto& rows = walk.answered.at(anchor);
        std::vector<Sample> ranges;
        for (std::size_t i = 0; i + 1 < rows.size(); ++i)
            if (const auto flight = double_sided(rows[i], rows[i + 1]))
                ranges.push_back({rows[i].time_s, flight->range_m()});
        return ranges;
    }

    Walk walk;
};

TEST_F(UltraxWalk, EveryRowIsReadAndEveryAnsweredOneGivesARange) {
    EXPECT_EQ(walk.rows, 6163u);
    EXPECT_EQ(walk.unreadable, 0u);
    EXPECT_EQ(walk.unanswered, 813u);
    const std::map<unsigned, std::size_t> answered{{1, 828}, {2, 880}, {3, 900}, {4, 918}, {5, 923}, {6, 901}};
    for (const auto& [anchor, count] : answered) {
        ASSERT_EQ(walk.answered[anchor].size(), count) << "anchor " << anchor;
        const auto ranges = double_sided_ranges(anchor);
        EXPECT_EQ(ranges.size(), count - 1);
        std::vector<double> sorted;
        for (const auto& sample : ranges) sorted.push_back(sample.range_m);
        std::sort(sorted.begin(), sorted.end());
        std::printf("anchor %u: %zu ranges, first %.3f, last %.3f, median %.3f, min %.3f, max %.3f m\n", anchor,
                    ranges.size(), ranges.front().range_m, ranges.back().range_m, median(sorted), sorted.front(),
                    sorted.back());
    }
}

TEST_F(UltraxWalk, RangesAreThoseOfARoomAndTheOneThatIsNotIsTold) {
    std::size_t impossible = 0;
    for (const auto& [anchor, rows] : walk.answered)
        for (const auto& sample : double_sided_ranges(anchor))
            if (sample.range_m < 0 || sample.range_m > 12) ++impossible;
    EXPECT_EQ(impossible, 1u) << "anchor 6 at 324.47 s: -5.08 m";
}

/// Somebody who walks goes 3 m/s at most. Beyond that stands a range that the path between them and the anchor bent:
/// bodies and furniture. Compared with the median of five, as the walker's own movement bends no more than that.
TEST_F(UltraxWalk, RangesScatterByCentimetresAboutASmoothTrack) {
    for (const auto& [anchor, rows] : walk.answered) {
        const auto ranges = double_sided_ranges(anchor);
        std::vector<double> off;
        std::size_t too_fast = 0;
        for (std::size_t i = 2; i + 2 < ranges.size(); ++i) {
            std::vector<double> near;
            for (std::size_t j = i - 2; j <= i + 2; ++j) near.push_back(ranges[j].range_m);
            const double residual_m = std::abs(ranges[i].range_m - median(near));
            off.push_back(residual_m);
            const double reach_m = 3 * (ranges[i + 2].time_s - ranges[i].time_s);
            if (residual_m > reach_m) ++too_fast;
        }
        const double share = static_cast<double>(too_fast) / static_cast<double>(off.size());
        std::printf("anchor %u: spread %.3f m, faster than a walker %.1f %%\n", anchor, 1.4826 * median(off),
                    100 * share);
        EXPECT_LT(1.4826 * median(off), 0.05) << "anchor " << anchor;
        EXPECT_LT(share, 0.06) << "anchor " << anchor;
    }
}

TEST_F(UltraxWalk, CrystalsDifferByAFewPartsInAMillionAndThatIsDecimetresWithoutCorrection) {
    double most_ppm = 0, most_uncorrected_m = 0;
    for (const auto& [anchor, rows] : walk.answered) {
        std::vector<double> rates_ppm, uncorrected_m;
        for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
            const double rate = rate_between(rows[i], rows[i + 1]);
            rates_ppm.push_back(rate * 1e6);
            const auto flight = double_sided(rows[i], rows[i + 1]);
            const auto corrected = uwb::single_sided(rows[i].exchange, rate);
            ASSERT_TRUE(flight && corrected);
            ASSERT_NEAR(corrected->range_m(), flight->range_m(), 1e-4);
            uncorrected_m.push_back(uwb::single_sided(rows[i].exchange, 0)->range_m() - flight->range_m());
        }
        const auto [low, high] = std::minmax_element(rates_ppm.begin(), rates_ppm.end());
        EXPECT_LT(*high - *low, 1.5) << "anchor " << anchor << ": over 72 s a crystal stays what it is";
        most_ppm = std::max(most_ppm, std::abs(median(rates_ppm)));
        most_uncorrected_m = std::max(most_uncorrected_m, std::abs(median(uncorrected_m)));
        std::printf("anchor %u: rate %.3f ppm (%.3f to %.3f), worth %.2f m\n", anchor, median(rates_ppm), *low, *high,
                    median(uncorrected_m));
    }
    EXPECT_NEAR(most_ppm, 4.43, 0.05);
    EXPECT_NEAR(most_uncorrected_m, 0.68, 0.05);
}

} // namespace
} // namespace locus::ultrax
