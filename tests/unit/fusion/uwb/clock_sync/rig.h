// Simulated anchors joined to a synchroniser: messages reach it in the order in which the host reads them, and what
// comes out is weighed against the truth and against what perfect clocks would have given.
#pragma once

#include "fusion/uwb/clock_sync/synchroniser.h"
#include "tests/unit/fusion/uwb/clock_sync/simulated_clocks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <queue>
#include <vector>

namespace locus::clock_test {

using uwb::ClockSynchroniser;

inline const std::vector<Vec3> hall{{0, 0, 3}, {20, 0, 2.5}, {20, 12, 3}, {0, 12, 2.5}, {10, 6, 5}};

struct Tally {
    double squares_m2 = 0, perfect_squares_m2 = 0, normalised_squares = 0, worst_in_sigma = 0;
    int count = 0;

    double rms_m() const { return std::sqrt(squares_m2 / count); }
    double ratio() const { return std::sqrt(squares_m2 / perfect_squares_m2); }
    double normalised() const { return normalised_squares / count; }
};

/// Delivers messages to a synchroniser in the order in which they reach the host, and weighs what comes out.
struct Rig final : ClockSynchroniser::Output {
    SimulatedAnchors world;
    ClockSyncSettings settings;
    std::map<Exclusion, int> reasons; ///< of arrivals
    std::map<Exclusion, int> sync_reasons;
    Tally all;
    std::map<std::pair<std::int64_t, std::size_t>, double> values_m; ///< by blink and anchor
    double count_from_s = 5;
    double last_good_s = 0;
    double longest_gap_s = 0;
    double window_s = 0.19;
    double longest_wait_s = 0;

    /// Everybody hears anchor 0.
    explicit Rig(unsigned seed) : world(seed) {
        world.place(hall);
        world.everyone_hears(0);
        world.send = [this](const Message& message) { on_the_way.push(message); };
        world.tag_position = [](double t) {
            return Eigen::Vector3d(10 + 8 * std::cos(t / 3), 6 + 4 * std::sin(t / 2), 1);
        };
    }

    void run(double until_s, const std::function<void(double)>& meddle = [](double) {}) {
        if (!synchroniser) synchroniser.emplace(world.site, settings, duration_from_s(window_s));
        while (world.time_s() < until_s) {
            world.step();
            meddle(world.time_s());
            const double now_s = 100 + world.time_s();
            for (; !on_the_way.empty() && on_the_way.top().host_s <= now_s; on_the_way.pop())
                hand_over(on_the_way.top().measurement);
            if (std::llround(world.time_s() / step_s) % 10 == 0) {
                tick_s = now_s;
                synchroniser->run(timestamp_from_s(now_s), *this);
            }
        }
    }

    Rig(const Rig&) = delete;
    Rig& operator=(const Rig&) = delete;

    void hand_over(const Measurement& measurement) {
        if (const auto* packet = std::get_if<ClockSync>(&measurement.observation))
            ++sync_reasons[synchroniser->hear(*packet, measurement.time).reason];
        else if (const auto reason = synchroniser->hear(measurement, {}); reason != Exclusion::none)
            ++reasons[reason];
    }

    void take(const Measurement& measurement, const AidBook::Record&) noexcept override {
        ++reasons[Exclusion::none];
        const auto& d = std::get<RangeDifference>(measurement.observation);
        EXPECT_EQ(d.tag, address(9));
        const std::size_t a = number(d.anchor_a), b = number(d.anchor_b);
        const auto& blink = blink_of(measurement);
        values_m[{blink.number, b}] = d.difference_m;
        const auto to = [&](std::size_t i) {
            return (vector(world.site.anchors[i].position_site_m) - blink.position).norm();
        };
        const double true_m = to(b) - to(a), error_m = d.difference_m - true_m;
        longest_wait_s = std::max(longest_wait_s, tick_s - to_s(measurement.time));
        longest_gap_s = std::max(longest_gap_s, to_s(measurement.time) - last_good_s);
        last_good_s = to_s(measurement.time);
        if (world.time_s() < count_from_s) return;
        ++all.count;
        all.squares_m2 += error_m * error_m;
        all.perfect_squares_m2 += std::pow(blink.noise_m[b] - blink.noise_m[a], 2);
        all.normalised_squares += std::pow(error_m / double{d.sigma_m}, 2);
        all.worst_in_sigma = std::max(all.worst_in_sigma, std::abs(error_m) / double{d.sigma_m});
    }
    void judge(const Measurement&, const AidBook::Record&, Exclusion reason) noexcept override { ++reasons[reason]; }

  private:
    struct Later {
        bool operator()(const Message& a, const Message& b) const { return a.host_s > b.host_s; }
    };
    struct TrueBlink {
        std::int64_t number;
        Eigen::Vector3d position;
        std::vector<double> noise_m;
    };
    std::priority_queue<Message, std::vector<Message>, Later> on_the_way;
    std::optional<ClockSynchroniser> synchroniser;
    double tick_s = 0;

    /// By its time: blinks come at regular intervals, and longer ones than messages are late by.
    TrueBlink blink_of(const Measurement& measurement) const {
        const double sent_s = to_s(measurement.time) - 100 - world.air.most_delay_s / 2;
        const double since_first_s = sent_s - 0.002 + world.air.blink_interval_s / 2;
        const auto number = static_cast<std::int64_t>(std::floor(since_first_s / world.air.blink_interval_s));
        TrueBlink blink{number, world.position_of_blink(static_cast<std::uint32_t>(number & 0xFF)), {}};
        for (std::size_t i = 0; i < world.site.anchors.size(); ++i)
            blink.noise_m.push_back(world.noise_between_m(0, i, static_cast<std::uint32_t>(number & 0xFF)));
        return blink;
    }
};

} // namespace locus::clock_test
