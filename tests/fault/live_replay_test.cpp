// The same bytes live and on replay. A recording is played into a pseudo-terminal; locusd reads it, publishes, and
// keeps what came (--record). The replay of what it kept must give the very poses that went out, and the recording that
// was played, moved in time, the same poses but for the jitter of the playing.
#include "config/load.h"
#include "daemon/socket/pose_line.h"
#include "tests/support/daemon_process.h"
#include "tests/support/socket_client.h"
#include "tests/support/source_folder.h"
#include "tests/unit/tools/fake_daemon.h"
#include "tools/play/player.h"
#include "tools/replay/recording.h"
#include "tools/replay/ticker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace locus {
namespace {

using nlohmann::json;
using Poses = std::map<std::int64_t, json>; ///< by tick, us

/// A pose by its tick, without what only the live one knows.
void take(Poses& poses, const std::string& line) {
    json pose = json::parse(line, nullptr, false);
    if (!pose.is_object() || pose["class"] != "POSE") return;
    const auto tick_us = std::llround(1e6 * pose["time"].get<double>());
    pose.erase("published");
    pose.erase("dropped");
    poses[tick_us] = std::move(pose);
}

struct Heard {
    Measurement measurement;
    Timestamp arrival;
};

std::vector<Heard> heard(const std::string& log, const Settings& settings) {
    std::vector<Heard> all;
    replay::read_recording(log, settings, [&](const Measurement& m, Timestamp at) { all.push_back({m, at}); });
    return all;
}

/// What `locus replay` gives, had everything been sampled `shift` later and come another `delay` later.
Poses replayed(const std::vector<Heard>& all, const Settings& settings, Duration shift, Duration delay) {
    Poses poses;
    Engine engine{settings.engine};
    replay::Ticker ticker{
        engine, [&](std::span<const Pose> at_tick) {
            for (const Pose& pose : at_tick)
                if (is_publishable(pose))
                    take(poses,
                         open_pose_line(pose, engine.target_name(pose.target_index), pose.estimate.reset_count) + '}');
        }};
    for (auto [measurement, arrival] : all) {
        measurement.time += shift;
        ticker.take(measurement, arrival + shift + delay);
    }
    ticker.finish();
    return poses;
}

std::array<double, 3> position(const json& pose) { return pose["position_site_m"].get<std::array<double, 3>>(); }

/// Horizontal distance to the nearest pose at most a tick and the jitter away in time.
double nearest_m(const Poses& poses, std::int64_t tick_us, double jitter_s, const json& pose) {
    const auto around_us = 10'000 + std::llround(1e6 * jitter_s);
    const auto a = position(pose);
    double nearest = std::numeric_limits<double>::infinity();
    for (auto other = poses.lower_bound(tick_us - around_us);
         other != poses.end() && other->first <= tick_us + around_us; ++other) {
        const auto b = position(other->second);
        nearest = std::min(nearest, std::hypot(a[0] - b[0], a[1] - b[1]));
    }
    return nearest;
}

class LiveReplay : public testing::Test {
  protected:
    /// Plays `recording` into the daemon at its own pace.
    void run(const std::string& recording) {
        const auto loaded = load_settings(config_);
        ASSERT_TRUE(loaded.settings) << to_string(loaded.problems.front());
        settings_ = *loaded.settings;
        test::DaemonProcess daemon{{"--config", config_, "--record", kept_}, log_};
        test::SocketClient client{socket_};
        ASSERT_EQ(client.ask("?WATCH={};", "WATCH")["enable"], true) << test::read_all(log_);
        std::jthread reader{[&] {
            while (const auto line = client.line()) take(live_, *line);
        }};
        const auto result = play::play(settings_.inputs, {recording, 1});
        EXPECT_EQ(result.lost, 0u);
        std::this_thread::sleep_for(std::chrono::milliseconds{200});
        daemon.signal(SIGTERM);
        reader.join();
        ASSERT_TRUE(test::eventually([&] { return daemon.exit_code().has_value(); }));
    }

    /// A measurement that is stamped just before a tick may reach the engine just after it: such a tick holds, to the
    /// last digit, the pose of a replay in which everything came some ticks later. On a busy machine a tick can even
    /// part the ranges of one line; such a pose is in neither replay, but near them, and rare.
    void expect_the_very_poses() const {
        const Duration period = duration_from_s(1 / settings_.engine.fusion.rate_hz);
        std::array<Poses, 6> replays;
        for (std::size_t late = 0; late < replays.size(); ++late)
            replays[late] = replayed(heard(kept_, settings_), settings_, Duration{}, static_cast<int>(late) * period);
        ASSERT_FALSE(replays[0].empty());
        std::size_t compared = 0, at_once = 0, parted = 0;
        for (const auto& [tick_us, pose] : live_) {
            if (tick_us > replays[0].rbegin()->first) break;
            ++compared;
            at_once += is_in(replays[0], tick_us, pose);
            if (std::ranges::any_of(replays, [&](const Poses& one) { return is_in(one, tick_us, pose); })) continue;
            ++parted;
            EXPECT_LT(nearest_m(replays[0], tick_us, 0, pose), 0.3)
                << "live " << pose << "\nreplay " << replays[0][tick_us];
        }
        EXPECT_LE(parted, compared / 100);
        EXPECT_GT(compared, 300u);
        EXPECT_GT(static_cast<double>(at_once), 0.9 * static_cast<double>(compared));
        std::printf("%zu live poses, %zu of them the replay's at the same tick to the last digit\n", compared, at_once);
    }

    static bool is_in(const Poses& poses, std::int64_t tick_us, const json& pose) {
        const auto found = poses.find(tick_us);
        return found != poses.end() && found->second == pose;
    }

    test::TemporaryFolder folder_;
    std::string config_ = folder_ / "locusd.yaml";
    std::string socket_ = folder_ / "locusd.sock";
    std::string kept_ = folder_ / "kept.log";
    std::string log_ = folder_ / "log";
    Settings settings_;
    Poses live_;
};

TEST_F(LiveReplay, OfASimulatedHall) {
    test::write_all(folder_ / "hall.yaml", R"(simulation: {seed: 3}
site:
  anchors:
    - {name: A0, address: 0, position_site_m: [0, 0, 0.5]}
    - {name: A1, address: 1, position_site_m: [10, 0, 2.5]}
    - {name: A2, address: 2, position_site_m: [10, 8, 0.5]}
    - {name: A3, address: 3, position_site_m: [0, 8, 2.5]}
targets:
  - {name: cart, address: 7, speed_mps: 1, waypoints_site_m: [[2, 2, 1], [8, 2, 1], [8, 6, 1], [2, 6, 1]]}
sensors:
  - {name: trek, transport: pty, path: )" + folder_ / "tty" +
                                               R"(, decoder: trek1000, rate_hz: 10, sigma_m: 0.05}
)");
    const auto simulate = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"simulate", folder_ / "hall.yaml"});
        return run_locus({add_simulate}, std::move(more));
    };
    test::write_all(config_, simulate({"--print-config", "--socket", socket_}).out);
    ASSERT_EQ(simulate({"--fast", "--duration", "5", "--record", folder_ / "hall.log"}).exit_code, exit_yes);
    ASSERT_NO_FATAL_FAILURE(run(folder_ / "hall.log"));
    expect_the_very_poses();
}

/// Eight seconds of a person who runs through a sports hall, as a TREK1000 printed it.
TEST_F(LiveReplay, OfTheSportsHall) {
    const char* named = std::getenv("LOCUS_DATA");
    const std::filesystem::path source = test::source_folder();
    const auto data = (named ? std::filesystem::path(named) : source / "../shared/data") / "cliansang_uwb_vicon";
    if (!std::filesystem::exists(data)) GTEST_SKIP() << "no cliansang_uwb_vicon in LOCUS_DATA or ../shared/data";
    const auto converter = source / "tools/convert/cliansang_uwb";
    const std::string out = folder_ / "op4";
    ASSERT_EQ(std::system((converter.string() + " " + data.string() + " op4 --out " + out + " >/dev/null").c_str()), 0);
    test::write_all(config_, test::read_all(out + "/op4.yaml") + "publish: {socket: " + socket_ + "}\n");
    ASSERT_EQ(std::system(("sed -n 101,180p " + out + "/op4.log >" + out + "/part.log").c_str()), 0);
    ASSERT_NO_FATAL_FAILURE(run(out + "/part.log"));
    expect_the_very_poses();

    const auto played = heard(out + "/part.log", settings_), kept = heard(kept_, settings_);
    ASSERT_EQ(played.size(), kept.size()) << "every range of the recording went through the terminal";
    std::vector<Duration> shifts;
    for (std::size_t i = 0; i < kept.size(); ++i)
        shifts.push_back(kept[i].measurement.time - played[i].measurement.time);
    std::ranges::sort(shifts);
    const Duration shift = shifts[shifts.size() / 2];
    const double jitter_s = std::max(to_s(shifts.back() - shift), to_s(shift - shifts.front()));
    const Poses before = replayed(played, settings_, shift, Duration{});
    // A range that the jitter carries over a tick is in one pose and not yet in the other, and each range is a small
    // jump: so the other's poses at the ticks around are looked at too.
    constexpr double fastest_mps = 10;
    const double allowed_m = fastest_mps * (0.01 + jitter_s);
    double worst_m = 0;
    for (const auto& [tick_us, pose] : live_)
        if (before.contains(tick_us)) worst_m = std::max(worst_m, nearest_m(before, tick_us, jitter_s, pose));
    std::printf("the recording itself, moved in time: at most %.1f cm apart; jitter of the playing %.1f ms\n",
                100 * worst_m, 1e3 * jitter_s);
    EXPECT_LT(worst_m, allowed_m) << "a tick and the jitter at a sprinter's speed";
}

} // namespace
} // namespace locus
