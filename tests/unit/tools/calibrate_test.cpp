// locus calibrate: files of people and of machines in, sentences and settings out.
#include "drivers/recording/measurement_json.h"
#include "tests/support/temporary_folder.h"
#include "tests/unit/tools/fake_daemon.h"
#include "tools/calibrate/merge.h"
#include "tools/completion.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <sstream>

namespace locus::calibrate {
namespace {

using testing::HasSubstr;
using testing::Not;

const std::string hall_yaml = R"(# taped by hand
site:
  name: hall
  anchors:
    - {name: NW, address: 0x8000, position_site_m: [0, 0, 0.3]}  # by the door
    - {name: N, address: 1, position_site_m: [14, 0, 2.9]}
    - name: NE
      address: 2
      position_site_m: [13.5, 9, 0.4]  # on the crane
      sigma_m: 0.2
    - {name: SE, address: 3, position_site_m: [0.5, 8.5, 3.1]}
    - {name: S, address: 4, position_site_m: [1, 1, 1], range_bias_m: 0.1}
targets: [{name: cart, address: 20}]
)";

const std::vector<Vec3> places_m{{0, 0, 0.3}, {14, 0, 2.9}, {13.5, 9, 0.4}, {0.5, 8.5, 3.1}, {7, -0.5, 2}};
const std::vector<std::string> names{"NW", "N", "NE", "SE", "S"};
constexpr std::array<std::uint64_t, 5> addresses{0x8000, 1, 2, 3, 4};

double distance_m(const Vec3& a, const Vec3& b) { return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]); }

std::string all_pairs() {
    std::string text = "a,b,range_m\n";
    for (std::size_t a = 0; a < names.size(); ++a)
        for (std::size_t b = 0; b < a; ++b)
            text += fmt::format("{}, {}, {:.4f}\n", names[a], names[b], distance_m(places_m[a], places_m[b]));
    return text;
}

class Calibrate : public testing::Test {
  protected:
    std::string file(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return folder_ / name;
    }
    std::string text_of(const std::string& path) const {
        std::ostringstream text;
        text << std::ifstream(path).rdbuf();
        return text.str();
    }
    CommandResult anchors(std::vector<std::string> words, const std::string& pairs = all_pairs()) const {
        words.insert(words.begin(), {"calibrate", "anchors", file("pairs.csv", pairs)});
        return run_locus({add_calibrate}, std::move(words));
    }
    std::string hall() const { return file("hall.yaml", hall_yaml); }

  private:
    test::TemporaryFolder folder_;
};

TEST_F(Calibrate, AnchorsAreFoundAndMergedAndCommentsStay) {
    const auto config = hall();
    const auto result = anchors({"--config", config, "--known", "NW,N,NE,SE", "--merge"});
    EXPECT_EQ(result.exit_code, exit_yes) << result.err;
    EXPECT_THAT(result.out, HasSubstr("10 pairs of 10 ranges; 7 pairs more than needed"));
    EXPECT_THAT(result.out, HasSubstr("{name: S, address: 4, position_site_m: [7, -0.5, 2]}"));
    EXPECT_EQ(text_of(config).find("{name: S, address: 4, position_site_m: [7, -0.5, 2], range_bias_m: 0.1}") ==
                  std::string::npos,
              false);
    EXPECT_THAT(text_of(config), HasSubstr("# by the door"));
    EXPECT_THAT(text_of(config), HasSubstr("position_site_m: [13.5, 9, 0.4]  # on the crane"));
}

TEST_F(Calibrate, TheMirrorImageIsAskedAboutAndAnswered) {
    const auto config = hall();
    const auto asked = anchors({"--config", config, "--known", "NW,N,NE"});
    EXPECT_EQ(asked.exit_code, exit_no);
    EXPECT_THAT(asked.err, HasSubstr("cannot tell the site from its mirror image"));
    EXPECT_THAT(asked.err, HasSubstr("--above or --below"));
    EXPECT_THAT(anchors({"--config", config, "--known", "NW,N,NE", "--above"}).out,
                HasSubstr("{name: SE, address: 3, position_site_m: [0.5, 8.5, 3.1]}"));
    EXPECT_THAT(anchors({"--config", config, "--known", "NW,N,NE", "--below"}).out,
                Not(HasSubstr("{name: SE, address: 3, position_site_m: [0.5, 8.5, 3.1]}")));
}

TEST_F(Calibrate, WithHeightsLeftOrRightIsAsked) {
    const std::string pairs = "0,1,10\n0,2,8\n1,2,12.8062\n0,3,5\n1,3,8.0623\n2,3,5\n";
    EXPECT_THAT(anchors({"--height", "2.5"}, pairs).err, HasSubstr("looking from A0 to A1"));
    const auto left = anchors({"--height", "2.5", "--mirror", "left", "--json"}, pairs);
    ASSERT_EQ(left.exit_code, exit_yes) << left.err;
    const auto report = nlohmann::json::parse(left.out);
    EXPECT_NEAR(report.at("anchors").at(2).at("position_site_m").at(1).get<double>(), 8, 0.01);
    EXPECT_EQ(report.at("anchors").at(2).at("position_site_m").at(2), 2.5);
}

TEST_F(Calibrate, AnAnswerAsksForTheHeightsWhenAllHangEquallyHigh) {
    std::string pairs;
    for (std::size_t a = 0; a < 5; ++a)
        for (std::size_t b = 0; b < a; ++b)
            pairs += fmt::format("{},{},{:.4f}\n", a, b,
                                 std::hypot(places_m[a][0] - places_m[b][0], places_m[a][1] - places_m[b][1]));
    const auto result = anchors({"--above"}, pairs);
    EXPECT_EQ(result.exit_code, exit_no);
    EXPECT_THAT(result.err, HasSubstr("does not follow from these distances"));
    EXPECT_THAT(result.err, HasSubstr("--heights"));
    EXPECT_EQ(result.out, "");
}

TEST_F(Calibrate, APairThatIsBlockedIsNamed) {
    const auto result =
        anchors({"--config", hall(), "--known", "NW,N,NE,SE", "--sigma-m", "0.05"}, all_pairs() + "S,NE,99\nS,NE,99\n");
    EXPECT_EQ(result.exit_code, exit_yes) << result.err;
    EXPECT_THAT(result.out, HasSubstr("NE - S: 99.000 m measured"));
}

TEST_F(Calibrate, EveryLineThatIsWrongIsTold) {
    const auto config = hall();
    const auto result = anchors({"--config", config},
                                "NW,N,14\nNW,XX,3\nN,N,4\nN,NE,nan\nN,NE,-3\nN,NE,inf\nN,NE\nN,NE,3,0\nN,NE,3,nan\n");
    EXPECT_EQ(result.exit_code, exit_usage);
    EXPECT_THAT(result.err, HasSubstr("pairs.csv:2: the site has no anchor \"XX\""));
    EXPECT_THAT(result.err, HasSubstr(":3: anchor 1 cannot measure itself"));
    EXPECT_THAT(result.err, HasSubstr(":4: nan m is no distance"));
    EXPECT_THAT(result.err, HasSubstr(":5: -3 m is no distance"));
    EXPECT_THAT(result.err, HasSubstr(":6: inf m is no distance"));
    EXPECT_THAT(result.err, HasSubstr(":7: it is not a,b,range_m"));
    EXPECT_THAT(result.err, HasSubstr(":8: 0 m is no standard deviation"));
    EXPECT_THAT(result.err, HasSubstr("8 lines cannot be used"));
}

TEST_F(Calibrate, WhatCannotBeSurveyedSaysWhatToMeasure) {
    EXPECT_THAT(anchors({}, "0,1,5\n0,2,6\n1,2,7\n").err, HasSubstr("measure at least 4"));
    EXPECT_THAT(anchors({}, "0,1,5\n0,2,6\n1,2,7\n3,4,5\n3,5,5\n4,5,5\n").err, HasSubstr("joins the groups of A0, A3"));
    EXPECT_THAT(anchors({"--config", hall(), "--known", "NW,N"}).err, HasSubstr("three known anchors"));
    EXPECT_THAT(anchors({"--known", "1"}, "0,1,5\n").err, HasSubstr("name them with --config"));
    EXPECT_THAT(anchors({"--config", hall(), "--known", "XX"}).err, HasSubstr("--known XX: no such anchor"));
    EXPECT_THAT(anchors({}, "").err, HasSubstr("no distance between two anchors was found"));
    EXPECT_THAT(anchors({"--merge"}, "0,1,5\n").err, HasSubstr("name them with --config"));
    EXPECT_THAT(anchors({}, "NW,N,5\n").err, HasSubstr("without --config no address is \"NW\""));
    EXPECT_THAT(anchors({}, "0,1,10\n1,2,9\n0,2,19\n2,3,5\n0,3,24\n1,3,14\n").err, HasSubstr("stand in one line"));
}

TEST_F(Calibrate, RecordingsInWhichAnchorsRangeEachOther) {
    std::string lines;
    for (std::size_t a = 0; a < names.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            const double range_m = distance_m(places_m[a], places_m[b]);
            const Address one = address(addresses[a]), other = address(addresses[b]);
            const Observation observation =
                a == 4 ? Observation{Range{one, other, range_m}} : Observation{PeerRange{one, other, range_m}};
            lines += to_json_line({timestamp_from_s(static_cast<double>(a)), 0, 0, observation}) + "\n";
        }
    lines += to_json_line({timestamp_from_s(9), 0, 0, PeerRange{address(1), address(20), 4}}) + "\n";
    const auto run = [&](const std::string& text) {
        return run_locus({add_calibrate}, {"calibrate", "anchors", file("walkabout.jsonl", text), "--config", hall(),
                                           "--known", "NW,N,NE,SE"});
    };
    const auto result = run(lines);
    EXPECT_EQ(result.exit_code, exit_yes) << result.err;
    EXPECT_THAT(result.out, HasSubstr("{name: S, address: 4, position_site_m: [7, -0.5, 2]}"));
    EXPECT_THAT(result.out, HasSubstr("1 ranges of others than anchors were left out"));
    const auto mixed = run(lines + to_json_line({timestamp_from_s(9), 0, 0, Range{address(1), address(1), 4}}) + "\n");
    EXPECT_EQ(mixed.exit_code, exit_usage);
    EXPECT_THAT(mixed.err, HasSubstr("tags and anchors have the same numbers"));
}

/// A walk among four anchors high and low, exact ranges with a bias of -0.3 m and one of its own.
std::string walk(double own_bias_m) {
    std::string lines;
    for (int i = 0; i < 600; ++i) {
        const double time_s = 0.1 * i, angle = 0.25 * time_s;
        const Vec3 at_m{7 + 5 * std::cos(angle), 4.5 + 3 * std::sin(angle), 1.3 + 0.6 * std::sin(2.3 * angle)};
        for (std::size_t a = 0; a < 4; ++a)
            lines += to_json_line({timestamp_from_s(time_s + 0.01 * static_cast<double>(a)), 0, 0,
                                   Range{address(addresses[a]), address(20),
                                         distance_m(at_m, places_m[a]) - 0.3 + (a == 2 ? own_bias_m : 0)}}) +
                     "\n";
    }
    return lines;
}

TEST_F(Calibrate, BiasOfAWalkIsFoundAndMerged) {
    const auto config = hall();
    const auto result = run_locus(
        {add_calibrate}, {"calibrate", "bias", file("walk.jsonl", walk(0.2)), "--config", config, "--merge", "--json"});
    ASSERT_EQ(result.exit_code, exit_yes) << result.err;
    const auto report = nlohmann::json::parse(result.out);
    for (std::size_t a = 0; a < 4; ++a) {
        const auto& anchor = report.at("anchors").at(a);
        const double true_m = a == 2 ? -0.1 : -0.3;
        EXPECT_LT(std::abs(anchor.at("range_bias_m").get<double>() - true_m), 3 * anchor.at("sigma_m").get<double>());
    }
    EXPECT_THAT(text_of(config), HasSubstr("# on the crane"));
    EXPECT_THAT(text_of(config), HasSubstr("range_bias_m: "));
}

TEST_F(Calibrate, BiasThatCannotBeFoundSaysWhy) {
    const auto config = hall();
    const auto bias = [&](const std::string& text, std::vector<std::string> words = {}) {
        words.insert(words.begin(), {"calibrate", "bias", file("walk.jsonl", text), "--config", config});
        return run_locus({add_calibrate}, std::move(words));
    };
    EXPECT_THAT(bias("").err, HasSubstr("holds no range of an anchor of the site"));
    const auto line = [](const Observation& one) { return to_json_line({timestamp_from_s(1), 0, 0, one}) + "\n"; };
    EXPECT_THAT(bias(line(RangeDifference{address(1), address(2), address(20), 1})).err,
                HasSubstr("range differences"));
    EXPECT_THAT(bias(line(Range{address(1), address(20), 3})).err, HasSubstr("no position to start from"));
    const auto two = line(Range{address(1), address(20), 3}) + line(Range{address(1), address(21), 3});
    EXPECT_THAT(bias(two).err, HasSubstr("say --target with one of cart, 21"));
    EXPECT_THAT(bias(two, {"--target", "7"}).err, HasSubstr("no range is of 7; there are ranges of cart, 21"));
    EXPECT_THAT(bias(walk(0), {"--truth", "/nonexistent.tum"}).err, HasSubstr("/nonexistent.tum"));
    EXPECT_EQ(bias(walk(0), {"--truth", file("far.tum", "900 0 0 0\n900.1 0 0 0\n")}).exit_code, exit_usage);
}

TEST(MergeIntoSettings, BiasIsPutBesideThePositionInEitherForm) {
    const std::string text = merged(hall_yaml, {{address(1), {}, -0.25}, {address(2), {}, 0.5}, {address(4), {}, 0.0}});
    EXPECT_THAT(text, HasSubstr("{name: N, address: 1, position_site_m: [14, 0, 2.9], range_bias_m: -0.25}"));
    EXPECT_THAT(text, HasSubstr("position_site_m: [13.5, 9, 0.4]\n      range_bias_m: 0.5  # on the crane\n"));
    EXPECT_THAT(text, HasSubstr("position_site_m: [1, 1, 1], range_bias_m: 0}"));
}

TEST(MergeIntoSettings, WhatCannotBeEditedIsToldAndNothingChanges) {
    EXPECT_THROW(merged(hall_yaml, {{address(99), Vec3{1, 2, 3}, {}}}), std::runtime_error);
    EXPECT_THROW(merged("site: {name: [", {{address(1), Vec3{1, 2, 3}, {}}}), std::runtime_error);
    const std::string block =
        "site:\n  anchors:\n    - name: a\n      address: 1\n      position_site_m:\n        - 1\n"
        "        - 2\n        - 3\n";
    EXPECT_THROW(merged(block, {{address(1), Vec3{1, 2, 3}, {}}}), std::runtime_error);
}

TEST(CalibrateCompletion, KnowsItsWords) {
    CLI::App root{"locus"};
    int exit_code = 0;
    add_calibrate(root, exit_code);
    EXPECT_THAT(tools::bash_completion(root), HasSubstr("' calibrate anchors'"));
    EXPECT_THAT(tools::bash_completion(root), HasSubstr("--known"));
    EXPECT_THAT(tools::bash_completion(root), HasSubstr("' calibrate camera walk'"));
    EXPECT_THAT(tools::bash_completion(root), HasSubstr("--frames"));
}

} // namespace
} // namespace locus::calibrate
