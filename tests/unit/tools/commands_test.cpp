// The commands that ask the daemon, run against one that answers by docs/protocol.md.
#include "tests/unit/tools/fake_daemon.h"

#include <gmock/gmock.h>

namespace locus {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

constexpr const char* sources_line =
    R"({"class":"SOURCES","sources":[)"
    R"({"kind":"anchor","name":"north","address":"0x1","input":"uwb","used":true,"reason":"used","sentence":"used","observation":4.125,"innovation":0.031,"innovation_sigma":0.12,"test_ratio":0.1,"rate_hz":9.96,"age_s":0.012,"counters":{"received":200,"used":150,"refused":50,"late":0}},)"
    R"({"kind":"anchor","address":"0x2","used":false,"reason":"innovation_too_large","sentence":"disagrees with the other sources by more than chance allows","rate_hz":9.8,"test_ratio":1.7}],)"
    R"("inputs":[{"name":"uwb","transport":"serial","decoder":"trek1000","state":"waiting","error":"/dev/ttyACM0 is not there","bytes":10,"packets":5,"frames":4,"measurements":16,"refused":{"malformed":3},"resyncs":6,"reconnects":1,"ring_dropped":2,"kernel_dropped":1,"age_s":3.0,"bytes_per_s":51.2,"frames_per_s":2.5,"measurements_per_s":10,"last_error":"x","last_error_age_s":1},{"name":"yard","state":"open","error":"","last_error":"it fell off","last_error_age_s":75}]})"
    "\n";
constexpr const char* targets_line =
    R"({"class":"TARGETS","targets":[)"
    R"({"name":"cart","address":"0xa","estimator":"range_ekf","has_pose":true,"time":12.5,"age_s":0.01,"position_site_m":[1.5,-2.25,0.75],"horizontal_error_95_m":0.21,"reset_count":1},)"
    R"({"name":"person","address":"0xb","estimator":"range_ekf","has_pose":false,"missing":"too few anchors are heard for a first position"}]})"
    "\n";
constexpr const char* working_line =
    R"({"class":"STATUS","working":true,"missing":[],"uptime_s":11520,"rate_hz":100,"ticks":1152000,"overruns":3,"tick_late_us":{"p50":12,"p99":60,"max":310},"clients":2,"config":"/etc/locusd/locusd.yaml","engine":{"received":1000,"late":2,"refused":3,"rolled_back":4},"memory_locked":true,"realtime":false})"
    "\n";
constexpr const char* waiting_line =
    R"({"class":"STATUS","working":false,"missing":["input uwb: /dev/ttyACM0 is not there: plug the device in"]})"
    "\n";
constexpr const char* watch_line = R"({"class":"WATCH","enable":true})"
                                   "\n";

std::string pose(double time_s, double horizontal_error_m) {
    return R"({"class":"POSE","target":"cart","time":)" + std::to_string(time_s) +
           R"(,"position_site_m":[1.5,-2.25,0.75],"velocity_site_mps":[3,4,0],"horizontal_error_95_m":)" +
           std::to_string(horizontal_error_m) + R"(,"vertical_error_95_m":0.5,"kinds_used":["RANGE","IMU"]})" + "\n";
}

TEST(Status, SaysThatItWorksOnOneScreen) {
    const FakeDaemon daemon({{"?STATUS", working_line}, {"?SOURCES", sources_line}, {"?TARGETS", targets_line}});
    const auto result = run_client({"status", "--socket", daemon.path()});
    EXPECT_EQ(result.exit_code, exit_yes);
    EXPECT_THAT(result.out, HasSubstr("locusd 0.1.0, site hall: working\n"));
    EXPECT_THAT(result.out, HasSubstr("1 of 2 open"));
    EXPECT_THAT(result.out, HasSubstr("1 of 2 used"));
    EXPECT_THAT(result.out, HasSubstr("1 of 2 have a position"));
    EXPECT_THAT(result.out, HasSubstr("3 h 12 min"));
    EXPECT_LE(std::ranges::count(result.out, '\n'), 24);
}

TEST(Status, SaysWhatIsMissingWhenNothingComesOut) {
    const FakeDaemon daemon({{"?STATUS", waiting_line}, {"?SOURCES", sources_line}, {"?TARGETS", targets_line}});
    const auto result = run_client({"status", "--socket", daemon.path()});
    EXPECT_EQ(result.exit_code, exit_no);
    EXPECT_THAT(result.out, HasSubstr("not working"));
    EXPECT_THAT(result.out, HasSubstr("  - input uwb: /dev/ttyACM0 is not there: plug the device in\n"));
}

TEST(Status, JsonIsTheDaemonsOwnLine) {
    const FakeDaemon daemon({{"?STATUS", waiting_line}});
    const auto result = run_client({"status", "--json", "--socket", daemon.path()});
    EXPECT_EQ(result.exit_code, exit_no);
    EXPECT_EQ(result.out, waiting_line);
}

TEST(Sources, ShowEachSourceWithItsSentenceAndEachInputWithItsError) {
    const FakeDaemon daemon({{"?SOURCES", sources_line}});
    const auto result = run_client({"sources", "--socket", daemon.path()});
    EXPECT_EQ(result.exit_code, exit_yes);
    EXPECT_THAT(result.out,
                testing::ContainsRegex("north +anchor +10\\.0 +12 ms +4\\.12 +0\\.03 +0\\.12 +0\\.10 +75 +used"));
    EXPECT_THAT(result.out, testing::ContainsRegex("0x2 +anchor .* 1\\.70 .*disagrees with the other sources"));
    EXPECT_THAT(result.out,
                testing::ContainsRegex("uwb +serial +trek1000 +waiting +3\\.0 s +51 +2\\.5 +10\\.0 +4 +3 +6 +3 +1\n"));
    EXPECT_THAT(result.out, HasSubstr("  uwb: /dev/ttyACM0 is not there\n"));
    EXPECT_THAT(result.out, HasSubstr("  uwb: 3 refused as malformed\n"));
    EXPECT_THAT(result.out, HasSubstr("  yard: well again; 1 min 15 s ago: it fell off\n"));
}

TEST(Sources, ASatelliteSaysWhatBecameOfItsCarrier) {
    const FakeDaemon daemon({{"?SOURCES", R"({"class":"SOURCES","sources":[)"
                                          R"({"name":"G05","used":true,"last_used_age_s":0.1,"carrier":"used"},)"
                                          R"({"name":"G07","used":true,"last_used_age_s":0.1,"carrier":"slipped"}]})"
                                          "\n"}});
    const std::string out = run_client({"sources", "--socket", daemon.path()}).out;
    EXPECT_THAT(out, testing::ContainsRegex("G05 .*used with its carrier"));
    EXPECT_THAT(out, testing::ContainsRegex("G07 .*used; its carrier disagrees"));
}

TEST(Sources, OneThatFellSilentIsNotInUse) {
    const FakeDaemon daemon(
        {{"?SOURCES",
          "{\"class\":\"SOURCES\",\"sources\":[{\"name\":\"north\",\"used\":true,\"last_used_age_s\":3.04}]}\n"}});
    EXPECT_THAT(run_client({"sources", "--socket", daemon.path()}).out, HasSubstr("silent for 3.0 s"));
}

TEST(Sources, AnAnchorThatIsNotWellSaysWhatAilsIt) {
    const FakeDaemon daemon(
        {{"?SOURCES", R"({"class":"SOURCES","sources":[{"name":"north","used":true,"health":{"state":"moved",)"
                      R"("sentence":"survey it again","since_s":200,"residual_m":0.4,"residual_sigma_m":0.03,)"
                      R"("moved_m":1.2,"stands_site_m":[13,9.2,null],"stands_covariance_m2":[0.01,0,0,0.04,0,9]}},)"
                      R"({"name":"south","used":true,"health":{"state":"good","sentence":"agrees"}}]})"
                      "\n"}});
    const auto out = run_client({"sources", "--socket", daemon.path()}).out;
    EXPECT_THAT(out, HasSubstr("  north: moved for 3 min 20 s: survey it again; its ranges are +0.40 m off (+-0.03); "
                               "moved by 1.20 m, it seems to stand at [13.00, 9.20, ?] (+-0.20)\n"));
    EXPECT_THAT(out, testing::Not(HasSubstr("south: ")));
}

TEST(Targets, ShowWhereTheyAreOrWhatStandsInTheWay) {
    const FakeDaemon daemon({{"?TARGETS", targets_line}});
    const auto result = run_client({"targets", "--socket", daemon.path()});
    EXPECT_EQ(result.exit_code, exit_yes);
    EXPECT_THAT(result.out, testing::ContainsRegex("cart +1\\.50 +-2\\.25 +0\\.75 +0\\.21 .*located"));
    EXPECT_THAT(result.out, testing::ContainsRegex("person .*too few anchors are heard"));
}

TEST(Watch, PrintsAsManyPosesAsAskedForAndStops) {
    const FakeDaemon daemon(
        {{"?WATCH", watch_line + pose(1, 0.2) + pose(2, 0.2) + pose(3, 0.2)}, {"?TARGETS", targets_line}});
    const auto result = run_client({"watch", "--count", "2", "--socket", daemon.path()});
    EXPECT_EQ(result.exit_code, exit_yes);
    EXPECT_THAT(result.out, testing::MatchesRegex("1\\.000 cart .* 5\\.00 m/s .*RANGE IMU\n2\\.000 cart [^\n]*\n"));
}

TEST(Watch, JsonPassesTheDaemonsLinesOn) {
    const FakeDaemon daemon({{"?WATCH", watch_line + pose(1, 0.2)}, {"?TARGETS", targets_line}});
    const auto result = run_client({"watch", "--json", "--count", "1", "--socket", daemon.path()});
    EXPECT_EQ(result.out, pose(1, 0.2));
    EXPECT_EQ(daemon.commands().front(), R"(?WATCH={"enable":true};)");
}

TEST(Watch, AsksForWhatWasAskedForWhateverTheName) {
    const FakeDaemon daemon({{"?WATCH", watch_line + pose(1, 0.2)}, {"?TARGETS", targets_line}});
    run_client(
        {"watch", "--count", "1", "--rate", "2.5", "--target", "a;b", "--target", "cart", "--socket", daemon.path()});
    EXPECT_EQ(daemon.commands().front(), R"(?WATCH={"enable":true,"rate_hz":2.5,"targets":["a\u003bb","cart"]};)");
}

TEST(Watch, EndsInTimeWithoutAPoseAndSaysNo) {
    const FakeDaemon daemon({{"?WATCH", watch_line}, {"?TARGETS", targets_line}});
    EXPECT_EQ(run_client({"watch", "--seconds", "0.05", "--socket", daemon.path()}).exit_code, exit_no);
}

TEST(Watch, GoesOnWhenTheDaemonComesBack) {
    const FakeDaemon daemon({{"?WATCH", watch_line + pose(1, 0.2)}}); // ends the connection at ?TARGETS
    const auto result = run_client({"watch", "--json", "--count", "2", "--socket", daemon.path()});
    EXPECT_EQ(result.exit_code, exit_yes);
    EXPECT_EQ(result.out, pose(1, 0.2) + pose(1, 0.2)) << "nothing but poses";
    EXPECT_THAT(result.err, HasSubstr("waiting for it to come back\nlocus: connected again\n"));
}

TEST(Watch, SaysSoWhenTheDaemonIsStillGoneAtTheEnd) {
    auto daemon = std::make_unique<FakeDaemon>(
        FakeDaemon::Answers{{"?WATCH", watch_line + pose(1, 0.2)}, {"?TARGETS", targets_line}});
    const std::string path = daemon->path();
    CommandResult result;
    std::jthread end{[&] {
        while (daemon->commands().empty()) std::this_thread::yield();
        daemon.reset();
    }};
    result = run_client({"watch", "--seconds", "0.5", "--socket", path});
    EXPECT_EQ(result.exit_code, exit_no_daemon);
    EXPECT_THAT(result.err, HasSubstr("locusd is not running"));
}

TEST(Watch, RefusalsOfTheDaemonAreShown) {
    const FakeDaemon daemon({{"?WATCH", "{\"class\":\"ERROR\",\"message\":\"rate_hz must be above 0\"}\n"}});
    const auto result = run_client({"watch", "--socket", daemon.path()});
    EXPECT_EQ(result.exit_code, exit_no_daemon);
    EXPECT_THAT(result.err, HasSubstr("rate_hz must be above 0"));
}

TEST(Wait, TakesTheFirstPoseThatIsGoodEnough) {
    const FakeDaemon daemon({{"?WATCH", watch_line + pose(1, 0.9) + pose(2, 0.3) + pose(3, 0.29) + pose(4, 0.1)}});
    const auto result = run_client({"wait", "--better-than", "0.3", "--json", "--socket", daemon.path()});
    EXPECT_EQ(result.exit_code, exit_yes);
    EXPECT_EQ(result.out, pose(3, 0.29));
}

TEST(Wait, SaysHowFarEachTargetGotWhenTheTimeIsOver) {
    const FakeDaemon daemon({{"?WATCH", watch_line + pose(1, 0.9)}, {"?TARGETS", targets_line}});
    const auto result = run_client({"wait", "--better-than", "0.1", "--timeout", "0.05", "--socket", daemon.path()});
    EXPECT_EQ(result.exit_code, exit_no);
    EXPECT_EQ(result.out, "");
    EXPECT_THAT(result.err, HasSubstr("no target known to better than 0.1 m after 0.05 s"));
    EXPECT_THAT(result.err, HasSubstr("  cart: known to 0.21 m\n"));
    EXPECT_THAT(result.err, HasSubstr("  person: too few anchors are heard for a first position\n"));
}

TEST(Wait, SpeaksOnlyOfTheTargetAskedFor) {
    const FakeDaemon daemon({{"?WATCH", watch_line}, {"?TARGETS", targets_line}});
    const auto result =
        run_client({"wait", "--better-than", "0.1", "--timeout", "0", "--target", "person", "--socket", daemon.path()});
    EXPECT_THAT(result.err, HasSubstr("person"));
    EXPECT_THAT(result.err, Not(HasSubstr("cart")));
}

TEST(Reload, TellsSuccessMistakesAndRefusalApart) {
    const auto reload = [](const char* answer) {
        const FakeDaemon daemon({{"?RELOAD", answer}});
        return run_client({"reload", "--socket", daemon.path()});
    };
    EXPECT_EQ(reload("{\"class\":\"RELOAD\",\"ok\":true,\"problems\":[]}\n").exit_code, exit_yes);
    const auto mistakes = reload("{\"class\":\"RELOAD\",\"ok\":false,\"problems\":[\"site.yaml:3:5: unknown key\"]}\n");
    EXPECT_EQ(mistakes.exit_code, exit_no);
    EXPECT_THAT(mistakes.err, HasSubstr("  site.yaml:3:5: unknown key\n"));
    const auto refused = reload("{\"class\":\"ERROR\",\"message\":\"only root may do that\"}\n");
    EXPECT_EQ(refused.exit_code, exit_no);
    EXPECT_THAT(refused.err, HasSubstr("only root may do that"));
}

TEST(Help, EveryCommandHasAnExample) {
    for (const char* command : {"status", "sources", "targets", "watch", "wait", "reload"}) {
        const auto result = run_client({command, "--help"});
        EXPECT_EQ(result.exit_code, exit_yes) << command;
        EXPECT_THAT(result.out, HasSubstr(std::string("locus ") + command)) << command;
        EXPECT_THAT(result.out, HasSubstr("Example")) << command;
    }
}

TEST(Help, WrongUseIsExitCodeTwo) {
    EXPECT_EQ(run_client({"watch", "--count", "none"}).exit_code, exit_usage);
    EXPECT_EQ(run_client({"wait"}).exit_code, exit_usage);
    EXPECT_EQ(run_client({"stauts"}).exit_code, exit_usage);
}

} // namespace
} // namespace locus
