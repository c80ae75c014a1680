// How figures, tables and the live panel read.
#include "tools/client/client.h"
#include "tools/show/pose_panel.h"
#include "tools/show/table.h"
#include "tools/show/words.h"

#include <gmock/gmock.h>

namespace locus::tools {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::MatchesRegex;

TEST(Words, DurationsGrowTheirUnit) {
    EXPECT_EQ(duration(0.0123), "12 ms");
    EXPECT_EQ(duration(-0.002), "-2 ms");
    EXPECT_EQ(duration(0.9996), "1.0 s");
    EXPECT_EQ(duration(3.21), "3.2 s");
    EXPECT_EQ(duration(200), "3 min 20 s");
    EXPECT_EQ(duration(11520), "3 h 12 min");
    EXPECT_EQ(duration(200000), "2 d 7 h");
    EXPECT_EQ(duration(std::nullopt), "-");
    EXPECT_EQ(duration(1e300), "-");
}

TEST(Words, UnknownFiguresAreADash) {
    EXPECT_EQ(figure(std::nullopt, 2), "-");
    EXPECT_EQ(figure(1.005, 1), "1.0");
}

TEST(Table, ColumnsAreAsWideAsTheyNeedToBe) {
    Table table({{"name"}, {"m", Align::right}, {"state"}});
    table.add({"Müller", "12.5", "used"});
    table.add({"b", "3", ""});
    EXPECT_THAT(table.lines(), ElementsAre("name       m  state", "Müller  12.5  used", "b          3"));
}

TEST(Table, TheLastCellOfAShortRowRunsOn) {
    Table table({{"name"}, {"m", Align::right, 6}, {"state"}});
    table.add({"a", "a sentence that needs room"});
    table.add({"b", "3", "used"});
    EXPECT_THAT(table.lines(),
                ElementsAre("name       m  state", "a     a sentence that needs room", "b          3  used"));
}

TEST(Table, ClipsAtCharactersNotBytes) {
    EXPECT_EQ(clip("Müller", 2), "Mü");
    EXPECT_EQ(clip("Müller", 6), "Müller");
    EXPECT_EQ(clip("Müller", 60), "Müller");
    EXPECT_EQ(clip("Müller", 0), "");
}

Message version() { return parse_message(R"({"class":"VERSION","release":"0.1.0","site":"hall"})"); }
Message pose(const std::string& target) {
    return parse_message(R"({"class":"POSE","target":")" + target + R"(","time":100,"position_site_m":[1,2,3]})");
}
constexpr const char* lost =
    R"({"class":"TARGETS","targets":[{"name":"cart","has_pose":false,"missing":"not heard"}]})";
constexpr const char* found = R"({"class":"TARGETS","targets":[{"name":"cart","has_pose":true}]})";

TEST(PosePanel, ShowsThePoseUntilItIsLostAndThenWhy) {
    PosePanel panel(version());
    panel.take(pose("cart"));
    EXPECT_THAT(panel.lines(100.25), ElementsAre("locusd 0.1.0, site hall", HasSubstr("target"),
                                                 MatchesRegex("cart +1\\.000 +2\\.000 +3\\.000 .*250 ms .*")));
    panel.take(parse_message(lost));
    EXPECT_THAT(panel.lines(101), ElementsAre(testing::_, testing::_, MatchesRegex("cart +not heard")));
    panel.take(pose("cart"));
    EXPECT_THAT(panel.lines(100).back(), HasSubstr("1.000"));
}

TEST(PosePanel, ForgetsTargetsThatAreNoMore) {
    PosePanel panel(version());
    panel.take(pose("cart"));
    panel.take(pose("person"));
    panel.take(parse_message(found));
    EXPECT_THAT(panel.lines(100), ElementsAre(testing::_, testing::_, HasSubstr("cart")));
}

TEST(PosePanel, ShowsOnlyTheTargetsAskedFor) {
    PosePanel panel(version(), {"person"});
    panel.take(parse_message(lost));
    EXPECT_THAT(panel.lines(100), ElementsAre(testing::_, testing::_, HasSubstr("no target yet")));
}

} // namespace
} // namespace locus::tools
