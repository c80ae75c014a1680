// A recording through the engine: the same bytes every time, bad lines told and left out, and a reason when there is
// no pose.
#include "tools/replay/replay.h"

#include "drivers/recording/log_line.h"
#include "drivers/recording/measurement_json.h"
#include "drivers/uwb/trek1000.h"
#include "tests/unit/fusion/engine_fixture.h"
#include "tools/replay/ticker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace locus::replay {
namespace {

using engine_test::at;
using engine_test::range;
using testing::ElementsAre;
using testing::HasSubstr;

class Replay : public testing::Test {
  protected:
    Replay() {
        std::filesystem::create_directories(folder_);
        settings_.engine = engine_test::follower_settings();
    }
    ~Replay() override { std::filesystem::remove_all(folder_); }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream{path(name)} << text;
        return path(name);
    }

    std::string read(const std::string& name) const {
        std::ostringstream text;
        text << std::ifstream{path(name)}.rdbuf();
        return text.str();
    }

    Settings settings_;

  private:
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("locus_replay_" + std::to_string(::getpid()) + "_" +
                                                  testing::UnitTest::GetInstance()->current_test_info()->name());
};

/// Two tags at 50 Hz, their lines a little out of order.
std::string two_tags(double from_s, double seconds) {
    std::string text;
    const auto rows = static_cast<std::uint32_t>(50 * seconds);
    for (std::uint32_t i = 0; i < rows; ++i) {
        const double time_s = from_s + 0.02 * i - 0.03 * (i % 3);
        for (const std::uint64_t tag : {100u, 101u})
            text += to_json_line(range(time_s, 5 + std::sin(0.1 * i), i, i % 4, tag)) + '\n';
    }
    return text;
}

TEST_F(Replay, TheSameRecordingGivesTheSameBytes) {
    const auto file = write("two.jsonl", two_tags(10, 5));
    const auto first = replay(settings_, {file, {path("a.jsonl"), path("a.tum")}, "cart"});
    const auto second = replay(settings_, {file, {path("b.jsonl"), path("b.tum")}, "cart"});
    EXPECT_EQ(first.targets.at("cart").poses, 499u); // 10.00 to 14.98
    EXPECT_EQ(read("a.jsonl"), read("b.jsonl"));
    EXPECT_EQ(read("a.tum"), read("b.tum"));
    EXPECT_EQ(summary_json(first), summary_json(second));
    EXPECT_EQ(read("a.tum").substr(0, 12), "10.000000000");
    EXPECT_THAT(read("a.jsonl"), HasSubstr(R"({"class":"POSE","target":"cart","time":10.000000000,)"));
}

TEST_F(Replay, BadLinesAreToldWithTheirNumberAndLeftOut) {
    const std::string good = two_tags(10, 1);
    const auto cut = good.size() - 30; // as when the power went
    const auto file = write("bad.jsonl", "# a comment\n\nwhat?\n" + good.substr(0, cut) + "\n");
    const auto summary = replay(settings_, {file, {}, {}});
    EXPECT_EQ(summary.read.lines, 103u);
    EXPECT_EQ(summary.read.bad_lines, 2u);
    ASSERT_EQ(summary.read.problems.size(), 2u);
    EXPECT_THAT(summary.read.problems[0], HasSubstr("line 3: "));
    EXPECT_THAT(summary.read.problems[1], HasSubstr("line 103: "));
    EXPECT_EQ(summary.engine.received, 99u);
    EXPECT_TRUE(summary.has_poses());
}

TEST_F(Replay, LinesOfWindowsAreReadAsWell) {
    const auto file = write("crlf.jsonl", to_json_line(range(1, 5)) + "\r\n\r\n");
    const auto summary = replay(settings_, {file, {}, {}});
    EXPECT_EQ(summary.read.bad_lines, 0u);
    EXPECT_EQ(summary.engine.received, 1u);
}

TEST_F(Replay, ManyBadLinesAreCountedButNotAllTold) {
    std::string text;
    for (int i = 0; i < 1000; ++i) text += "nonsense\n";
    const auto summary = replay(settings_, {write("bad.jsonl", text), {}, {}});
    EXPECT_EQ(summary.read.bad_lines, 1000u);
    EXPECT_EQ(summary.read.problems.size(), ReadReport::most_told);
    EXPECT_THAT(what_is_missing(summary), ElementsAre("there is no measurement in it"));
}

TEST_F(Replay, SaysWhyThereIsNoPose) {
    const auto one = write("one.jsonl", to_json_line(range(1, 5)) + '\n'); // the follower needs two
    EXPECT_THAT(what_is_missing(replay(settings_, {one, {}, {}})),
                ElementsAre("cart: too few anchors are heard for a first position"));
    const auto empty = write("empty.jsonl", "");
    const auto summary = replay(settings_, {empty, {}, {}});
    EXPECT_FALSE(summary.has_poses());
    EXPECT_THAT(what_is_missing(summary), ElementsAre("there is no measurement in it"));
    settings_.engine.targets.clear();
    settings_.engine.fusion.accept_unknown_targets = false;
    EXPECT_THAT(what_is_missing(replay(settings_, {one, {}, {}})),
                ElementsAre("no measurement is of a target that is followed"));
}

InputSettings trek_input(const std::string& name) {
    InputSettings input;
    input.name = name;
    input.decoder = find_decoder("trek1000");
    input.decoder_settings = input.decoder->options.make();
    return input;
}

std::string trek_line(const std::string& input, double time_s, const std::string& text) {
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    return to_log_line(input, {.time = at(time_s), .data = bytes}) + '\n';
}

TEST_F(Replay, RawLinesGoThroughTheDecoderOfTheInputWithTheirName) {
    uwb::TrekReport report;
    report.mask = 7;
    report.range_mm = {5000, 5010, 5020};
    report.tag = 100;
    settings_.inputs = {trek_input("hall"), trek_input("yard")};
    settings_.inputs[0].delay_s = 0.02;
    settings_.inputs[1].enabled = false;
    const std::string line = uwb::encode(report);
    const auto file =
        write("raw.log", trek_line("hall", 10, line.substr(0, 9)) + trek_line("hall", 10, line.substr(9)) +
                             trek_line("yard", 10.1, line) + trek_line("hall", 10.2, "mc what\r\n") +
                             "(10.25) hall 123#00\n" + trek_line("hall", 10.3, line));
    const auto summary = replay(settings_, {file, {path("poses.jsonl")}, {}});
    EXPECT_EQ(summary.engine.received, 6u);
    EXPECT_EQ(summary.engine.used, 5u);
    EXPECT_EQ(summary.first_arrival, at(10));
    EXPECT_EQ(summary.read.lines_of_unknown_inputs.at("yard"), 1u);
    EXPECT_EQ(summary.read.refused[static_cast<std::size_t>(Refusal::malformed)], 1u);
    ASSERT_EQ(summary.read.problems.size(), 1u);
    EXPECT_THAT(summary.read.problems[0], HasSubstr("line 5: its input reads serial bytes"));
    EXPECT_THAT(summary_lines(summary),
                testing::Contains("  1 lines of 'yard' left out: no enabled input has this name"));
}

TEST_F(Replay, TumFilesHoldOneTargetOnly) {
    const auto file = write("two.jsonl", two_tags(10, 1));
    EXPECT_THROW(replay(settings_, {file, {path("a.tum")}, {}}), std::runtime_error);
    EXPECT_NO_THROW(replay(settings_, {file, {path("a.tum")}, "0x65"}));
}

TEST_F(Replay, FilesThatCannotBeUsedAreRefusedWithASentence) {
    const auto sentence = [&](const Request& request) -> std::string {
        try {
            replay(settings_, request);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return {};
    };
    const auto file = write("two.jsonl", two_tags(10, 1));
    EXPECT_THAT(sentence({path("absent.jsonl"), {}, {}}), HasSubstr("No such file"));
    EXPECT_THAT(sentence({write("poses.csv", "1,2\n"), {}, {}}), HasSubstr(".jsonl"));
    EXPECT_THAT(sentence({file, {path("poses.txt")}, {}}), HasSubstr(".tum"));
    EXPECT_THAT(sentence({file, {path("no/such/folder.tum")}, {}}), HasSubstr("cannot be written"));
    std::filesystem::create_symlink("/dev/full", path("full.tum"));
    EXPECT_THAT(sentence({file, {path("full.tum")}, "cart"}), HasSubstr("No space left"));
    std::filesystem::create_directory(path("folder.jsonl"));
    EXPECT_THAT(sentence({path("folder.jsonl"), {}, {}}), HasSubstr("cannot be read"));
}

TEST_F(Replay, ALongSilenceIsNotTickedThrough) {
    const auto file = write("gap.jsonl", two_tags(10, 1) + two_tags(1e9, 1));
    const auto summary = replay(settings_, {file, {path("poses.jsonl")}, "cart"});
    EXPECT_GT(summary.targets.at("cart").poses, 190u + 100u); // it is lost a second after it fell silent
    EXPECT_LT(summary.targets.at("cart").poses, 310u);
    EXPECT_EQ(summary.engine.late, 0u);
}

TEST(Ticker, TicksStandOnTheGridAndTakeInWhatCameByThen) {
    Engine engine(engine_test::follower_settings());
    std::vector<std::pair<Timestamp, std::uint64_t>> ticks;
    Ticker ticker(engine, [&](std::span<const Pose> poses) {
        ticks.emplace_back(poses[0].estimate.time, engine.counters().used + engine.counters().refused);
    });
    ticker.take(range(0.995, 5, 0), at(0.995));
    ticker.take(range(1.01, 5, 1), at(1.01)); // exactly at a tick: belongs to it
    ticker.take(range(1.005, 5, 2), at(1.005));
    ticker.finish();
    EXPECT_THAT(ticks, ElementsAre(std::pair{at(1.00), 1u}, std::pair{at(1.01), 3u}));
}

TEST(Ticker, TimesBeforeZeroHaveAGridToo) {
    Engine engine(engine_test::follower_settings());
    std::vector<Timestamp> ticks;
    Ticker ticker(engine, [&](std::span<const Pose> poses) { ticks.push_back(poses[0].estimate.time); });
    ticker.take(range(-0.015, 5), at(-0.015));
    ticker.take(range(0.001, 5, 1), at(0.001));
    ticker.finish();
    EXPECT_THAT(ticks, ElementsAre(at(-0.01), at(0), at(0.01)));
}

} // namespace
} // namespace locus::replay
