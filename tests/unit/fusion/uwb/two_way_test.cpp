// Times of flight from raw stamps, wherever the counters stand and however far apart the crystals are.
#include "fusion/uwb/two_way.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cmath>

namespace locus::uwb::two_way_test {
namespace {

constexpr std::uint64_t period = std::uint64_t{1} << 40;

TEST(Ticks, AreThoseOfTheDw1000) {
    EXPECT_NEAR(tick_s, 15.650040064e-12, 1e-20);
    EXPECT_NEAR(tick_m, 4.691763978616e-3, 1e-14);
    EXPECT_NEAR(static_cast<double>(WrappingClock{}.period_ticks()) * tick_s, 17.2074, 1e-4);
    EXPECT_NEAR(static_cast<double>(WrappingClock{32}.period_ticks()) * tick_s, 67.216e-3, 1e-6);
}

TEST(Ticks, IntervalsGoOnOverTheWrap) {
    const WrappingClock clock;
    EXPECT_EQ(clock.since(5, period - 5), 10);
    EXPECT_EQ(clock.since(period - 5, 5), static_cast<std::int64_t>(period) - 10);
    EXPECT_EQ(clock.between(period - 5, 5), -10);
    EXPECT_EQ(clock.between(period / 2, 0), -static_cast<std::int64_t>(period / 2));
    EXPECT_EQ(clock.since(~std::uint64_t{0}, 0), static_cast<std::int64_t>(period) - 1) << "higher bits do not count";
}

RC_GTEST_PROP(Ticks, IntervalsOfAnyLengthAreFoundNearTheirExpectation, ()) {
    const WrappingClock clock{*rc::gen::element(32, 40)};
    const auto interval = *rc::gen::inRange<std::int64_t>(-(std::int64_t{1} << 50), std::int64_t{1} << 50);
    const auto error = *rc::gen::inRange(-clock.period_ticks() / 2 + 1, clock.period_ticks() / 2);
    const auto earlier = *rc::gen::arbitrary<std::uint64_t>();
    const std::uint64_t later = earlier + static_cast<std::uint64_t>(interval);
    RC_ASSERT(clock.between_near(later, earlier, interval + error) == interval);
}

/// True times in ticks of a perfect clock, written down by two counters that run fast or slow.
struct Link {
    double a_start = 0, b_start = 0;
    long double a_rate = 1, b_rate = 1;

    std::uint64_t at_a(long double true_ticks) const { return stamp(a_start, a_rate, true_ticks); }
    std::uint64_t at_b(long double true_ticks) const { return stamp(b_start, b_rate, true_ticks); }

  private:
    static std::uint64_t stamp(double start, long double rate, long double true_ticks) {
        return static_cast<std::uint64_t>(std::llround(static_cast<long double>(start) + rate * true_ticks)) % period;
    }
};

DoubleSided exchange_of(const Link& link, double flight, double reply_b, double reply_a) {
    const long double answer = flight + reply_b, heard = answer + flight, final = heard + reply_a;
    return {{link.at_a(0), link.at_b(flight), link.at_b(answer), link.at_a(heard)},
            link.at_a(final),
            link.at_b(final + flight)};
}

constexpr double ms = 1e-3 / tick_s;

struct Case {
    double range_m, reply_b_ms, reply_a_ms, a_ppm, b_ppm;
};

TEST(TwoWay, FindsTheRangeForLongAndUnequalRepliesAndBadCrystals) {
    constexpr std::array cases{Case{10, 1, 1, 0, 0},       Case{10, 1, 70, 20, -20},   Case{300, 70, 1, -20, 20},
                               Case{0, 0.3, 0.3, 20, -20}, Case{5, 2000, 3000, 20, 1}, Case{5000, 1, 5, 5, -20}};
    for (const auto& c : cases) {
        const Link link{double(period) - 100, 7, 1 + 1e-6L * c.a_ppm, 1 + 1e-6L * c.b_ppm};
        const auto exchange = exchange_of(link, c.range_m / tick_m, c.reply_b_ms * ms, c.reply_a_ms * ms);
        const auto both = double_sided(exchange);
        ASSERT_TRUE(both);
        const double half_a_tick_m = 0.5 * tick_m, of_crystals_m = c.range_m * 21e-6;
        EXPECT_NEAR(both->range_m(), c.range_m, 2 * half_a_tick_m + of_crystals_m);
        const double rate = double((1 + 1e-6L * c.b_ppm) / (1 + 1e-6L * c.a_ppm) - 1);
        const auto one = single_sided(exchange.first, rate);
        ASSERT_TRUE(one);
        EXPECT_NEAR(one->range_m(), c.range_m, 2 * half_a_tick_m + of_crystals_m);
    }
}

RC_GTEST_PROP(TwoWay, IsExactToTheRoundingOfStampsAtEveryPhaseOfTheWrap, ()) {
    const auto whole = [](std::int64_t from, std::int64_t to) { return double(*rc::gen::inRange(from, to)); };
    const Link link{whole(0, period), whole(0, period), 1 + 1e-9L * whole(-20000, 20001),
                    1 + 1e-9L * whole(-20000, 20001)};
    const double flight = whole(0, 100000), reply_b = whole(1, 100 * std::int64_t(ms)),
                 reply_a = whole(1, 100 * std::int64_t(ms));
    const auto exchange = exchange_of(link, flight, reply_b, reply_a);
    const auto both = double_sided(exchange);
    const auto one = single_sided(exchange.first, double(link.b_rate / link.a_rate - 1));
    RC_ASSERT(both && one);
    RC_ASSERT(std::abs(both->ticks - flight) <= 1.1 + flight * 21e-6);
    RC_ASSERT(std::abs(one->ticks - flight) <= 1.1 + flight * 21e-6);
}

RC_GTEST_PROP(TwoWay, WhereTheCountersStandDoesNotMatterAtAll, ()) {
    const auto shift_a = *rc::gen::arbitrary<std::uint64_t>(), shift_b = *rc::gen::arbitrary<std::uint64_t>();
    const DoubleSided at_zero{{0, 1000, 70'000'000, 70'002'100}, 200'000'000, 199'998'900};
    DoubleSided shifted = at_zero;
    for (auto* stamp : {&shifted.first.poll_tx_ticks_in_a, &shifted.first.answer_rx_ticks_in_a, //
                        &shifted.final_tx_ticks_in_a})
        *stamp += shift_a;
    for (auto* stamp : {&shifted.first.poll_rx_ticks_in_b, &shifted.first.answer_tx_ticks_in_b, //
                        &shifted.final_rx_ticks_in_b})
        *stamp += shift_b;
    RC_ASSERT(double_sided(shifted)->ticks == double_sided(at_zero)->ticks);
    RC_ASSERT(single_sided(shifted.first, 1e-5)->ticks == single_sided(at_zero.first, 1e-5)->ticks);
}

RC_GTEST_PROP(TwoWay, HostileStampsGiveAFiniteNumberOrNone, ()) {
    const auto any = rc::gen::arbitrary<std::uint64_t>();
    const DoubleSided exchange{{*any, *any, *any, *any}, *any, *any};
    if (const auto both = double_sided(exchange)) RC_ASSERT(std::isfinite(both->ticks + both->sigma_ticks));
    const double rate = *rc::gen::arbitrary<double>();
    if (const auto one = single_sided(exchange.first, rate)) RC_ASSERT(std::isfinite(one->ticks + one->sigma_ticks));
}

TEST(TwoWay, RefusesWhatCannotBe) {
    const SingleSided good{0, 0, 1000, 1100};
    EXPECT_TRUE(single_sided(good, 0));
    EXPECT_FALSE(single_sided(good, std::nan("")));
    EXPECT_FALSE(single_sided(good, 0.01)) << "no crystal";
    EXPECT_FALSE(single_sided({0, 1000, 0, 1100}, 0)) << "answered before it was asked";
    EXPECT_FALSE(single_sided({1100, 0, 1000, 0}, 0));
    EXPECT_FALSE(double_sided({})) << "all intervals zero";
    EXPECT_FALSE(double_sided({good, 1000, 2000})) << "the final before the answer";
    EXPECT_FALSE(double_sided({good, 0, period - 1}));
}

TEST(TwoWay, SigmaIsTheSpreadThatNoisyStampsGive) {
    // The stamps' errors one by one, by differences: variances add.
    const auto exchange = exchange_of({}, 2000, 1 * ms, 3 * ms);
    TwoWaySettings settings;
    settings.rate_sigma = 0;
    const auto spread = [&](auto solve, std::initializer_list<std::uint64_t DoubleSided::*> finals) {
        double sum = 0;
        const auto vary = [&](auto&& stamp_of) {
            DoubleSided late = exchange;
            stamp_of(late) += 1000;
            sum += std::pow((solve(late) - solve(exchange)) / 1000, 2);
        };
        vary([](DoubleSided& e) -> std::uint64_t& { return e.first.poll_rx_ticks_in_b; });
        vary([](DoubleSided& e) -> std::uint64_t& { return e.first.answer_rx_ticks_in_a; });
        for (const auto member : finals) vary([member](DoubleSided& e) -> std::uint64_t& { return e.*member; });
        return settings.stamp_sigma_ticks * std::sqrt(sum);
    };
    const auto one = [&](const DoubleSided& e) { return single_sided(e.first, 0, settings)->ticks; };
    const auto two = [&](const DoubleSided& e) { return double_sided(e, settings)->ticks; };
    EXPECT_NEAR(single_sided(exchange.first, 0, settings)->sigma_ticks, spread(one, {}), 1e-3);
    EXPECT_NEAR(double_sided(exchange, settings)->sigma_ticks, spread(two, {&DoubleSided::final_rx_ticks_in_b}), 0.01);
}

TEST(TwoWay, AntennaDelayAndUncertainRateGoIn) {
    const auto exchange = exchange_of({}, 2000, 1 * ms, 1 * ms);
    TwoWaySettings settings;
    settings.antenna_delay_ticks = 150;
    settings.rate_sigma = 1e-6;
    EXPECT_NEAR(single_sided(exchange.first, 0, settings)->ticks, 1850, 0.5);
    EXPECT_NEAR(double_sided(exchange, settings)->ticks, 1850, 0.5);
    EXPECT_NEAR(single_sided(exchange.first, 0, settings)->sigma_m(), 0.15, 0.01) << "1 ppm of 1 ms";
}

} // namespace
} // namespace locus::uwb::two_way_test
