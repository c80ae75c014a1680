// `locus evaluate` as a person runs it, and its picture.
#include "tests/unit/tools/fake_daemon.h"

#include "tools/evaluate/plot.h"
#include "tools/evaluate/svg.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <sstream>

namespace locus {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class Evaluate : public testing::Test {
  protected:
    Evaluate() { std::filesystem::create_directories(folder_); }
    ~Evaluate() override { std::filesystem::remove_all(folder_); }

    std::string file(const std::string& name, const std::string& text) const {
        std::ofstream(folder_ / name) << text;
        return folder_ / name;
    }

    static CommandResult evaluate(std::vector<std::string> words) {
        words.insert(words.begin(), "evaluate");
        return run_locus({add_evaluate}, std::move(words));
    }

    // A circle with a climb; the estimate is off by (0.3, 0.4, 0) m.
    std::string truth() const { return file("truth.tum", circle(100, 0.05, {0, 0, 0})); }
    std::string estimate() const { return file("estimate.tum", circle(50, 0.1, {0.3, 0.4, 0})); }

    static std::string circle(int count, double step_s, std::array<double, 3> offset_m) {
        std::ostringstream out;
        for (int i = 0; i < count; ++i)
            out << i * step_s << ' ' << std::cos(i * step_s) + offset_m[0] << ' ' << std::sin(i * step_s) + offset_m[1]
                << ' ' << 0.1 * i * step_s + offset_m[2] << " 0 0 0 1\n";
        return out.str();
    }

    const std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("locus_evaluate_" + std::to_string(::getpid()));
};

TEST_F(Evaluate, GivesTheFiguresAsATable) {
    const auto result = evaluate({truth(), estimate()});
    EXPECT_EQ(result.exit_code, exit_yes);
    EXPECT_THAT(result.out, HasSubstr("compared 50 of 50 poses, from 0.000 s to 4.900 s"));
    EXPECT_THAT(result.out, testing::ContainsRegex("3D +0\\.500 +0\\.500 +0\\.500 +0\\.500 +0\\.500 +0\\.500"));
    EXPECT_THAT(result.out, testing::ContainsRegex("x +0\\.300 .*\\+0\\.300\n"));
    EXPECT_THAT(result.out, Not(HasSubstr("bound")));
}

TEST_F(Evaluate, AlignmentTakesTheOffsetAway) {
    const auto result = evaluate({truth(), estimate(), "--align", "yaw", "--json"});
    const auto json = nlohmann::json::parse(result.out);
    EXPECT_EQ(json["alignment"], "yaw");
    EXPECT_LT(json["spatial"]["rmse_m"].get<double>(), 1e-4); // the files have six digits
    EXPECT_NEAR(json["transformation"]["translation_m"][0].get<double>(), -0.3, 1e-3);
}

TEST_F(Evaluate, ScoresOnlyWhatIsSelected) {
    const auto result = evaluate({truth(), estimate(), "--min-z", "0.2", "--to", "4", "--json"});
    const auto json = nlohmann::json::parse(result.out);
    EXPECT_EQ(json["compared"], 21);
    EXPECT_EQ(json["not_selected"], 29);
}

TEST_F(Evaluate, TellsWhetherPublishedBoundsHeld) {
    std::string poses;
    for (int i = 0; i < 4; ++i)
        poses += R"({"class":"POSE","target":"cart","time":)" + std::to_string(i) +
                 R"(,"position_site_m":[0.5,0,0],"horizontal_error_95_m":)" + (i < 3 ? "0.6" : "0.4") + "}\n";
    const auto still = file("still.tum", "0 0 0 0\n1 0 0 0\n2 0 0 0\n3 0 0 0\n");
    const auto result = evaluate({still, file("poses.jsonl", poses)});
    EXPECT_THAT(result.out, HasSubstr("horizontal error within its published 95 % bound for 75.0 % of 4 poses"));
}

TEST_F(Evaluate, SaysWhatIsWrongWithAFile) {
    const auto broken = evaluate({truth(), file("broken.tum", "1 2 3\n")});
    EXPECT_EQ(broken.exit_code, exit_usage);
    EXPECT_THAT(broken.err, HasSubstr("broken.tum:1: 3 columns"));
    const auto apart = evaluate({truth(), file("apart.tum", "1000 1 2 3 0 0 0 1\n")});
    EXPECT_EQ(apart.exit_code, exit_usage);
    EXPECT_THAT(apart.err, HasSubstr("no pose can be compared: the truth is from 0.000 s to 4.950 s, the estimate from "
                                     "1000.000 s"));
    const auto still = file("still.tum", "0 1 1 1\n1 1 1 1\n");
    EXPECT_THAT(evaluate({truth(), still, "--align", "se3"}).err, HasSubstr("align with yaw"));
    EXPECT_EQ(evaluate({truth(), estimate(), "--align", "rotate"}).exit_code, exit_usage);
    EXPECT_THAT(evaluate({truth(), estimate(), "--svg", "/nowhere/a.svg"}).err, HasSubstr("cannot be written"));
}

TEST_F(Evaluate, DrawsAPicture) {
    const std::string picture = folder_ / "a.svg";
    ASSERT_EQ(evaluate({truth(), estimate(), "--svg", picture}).exit_code, exit_yes);
    std::stringstream svg;
    svg << std::ifstream(picture).rdbuf();
    EXPECT_THAT(svg.str(), testing::StartsWith("<svg "));
    EXPECT_THAT(svg.str(), testing::EndsWith("</svg>\n"));
    EXPECT_THAT(svg.str(), HasSubstr("estimate.tum against truth.tum"));
    EXPECT_THAT(svg.str(), HasSubstr("3D, RMSE 0.500 m"));
}

TEST(Plot, IsWholeWithOnePoseOrNoMovement) {
    using namespace evaluate;
    for (const int count : {1, 2, 5}) {
        std::vector<Pair> pairs;
        for (int i = 0; i < count; ++i) pairs.push_back({10.0 * i, {1e6, 2, 3}, {1e6, 2, 3}});
        const std::string svg = plot({}, pairs, {}, "still <&>");
        EXPECT_THAT(svg, Not(HasSubstr("nan")));
        EXPECT_THAT(svg, Not(HasSubstr("inf")));
        EXPECT_THAT(svg, HasSubstr("still &lt;&amp;>"));
    }
}

TEST(Ticks, AreRoundAndWithin) {
    EXPECT_THAT(evaluate::ticks({0, 1}, 5), ElementsAre(0, 0.2, 0.4, testing::DoubleEq(0.6), 0.8, 1));
    EXPECT_THAT(evaluate::ticks({-3, 12}, 3), ElementsAre(0, 5, 10));
    EXPECT_TRUE(evaluate::ticks({1, 1}, 5).empty());
}

} // namespace
} // namespace locus
