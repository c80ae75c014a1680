// Reading of tracks: what is taken, and what is said of what is not.
#include "tools/evaluate/read.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace locus::evaluate {
namespace {

using testing::HasSubstr;

Track tum(const std::string& text) {
    std::istringstream stream(text);
    return read_tum(stream, "flight.tum");
}

Track poses(const std::string& text, const std::string& target = "") {
    std::istringstream stream(text);
    return read_pose_lines(stream, "poses.jsonl", target);
}

template <class Read>
std::string complaint(Read read) {
    try {
        read();
    } catch (const FileError& error) {
        return error.what();
    }
    return "no complaint";
}

std::string tum_complaint(const std::string& text) {
    return complaint([&] { tum(text); });
}

std::string pose(const std::string& target, double time_s) {
    return R"({"class":"POSE","target":")" + target + R"(","time":)" + std::to_string(time_s) +
           R"(,"position_site_m":[1,2,3],"horizontal_error_95_m":0.25})" + "\n";
}

TEST(ReadTum, TakesCommentsBlankLinesTabsWindowsEndsAndAMissingQuaternion) {
    const Track track = tum("# t x y z\n\n  1.5 1 2 3 0 0 0 1\r\n1.6\t1e-3\t-2.5\t3\t0\t0\t0\t1\n"
                            "2 4 5 6");
    ASSERT_EQ(track.size(), 3u);
    EXPECT_EQ(track[0].time_s, 1.5);
    EXPECT_EQ(track[0].position_m, Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(track[1].position_m, Eigen::Vector3d(1e-3, -2.5, 3));
    EXPECT_EQ(track[2].position_m, Eigen::Vector3d(4, 5, 6));
    EXPECT_TRUE(std::isnan(track[0].horizontal_bound_m));
}

TEST(ReadTum, SaysWhichLineIsWrongAndWhy) {
    EXPECT_EQ(tum_complaint("# head\n1 1 2 3 0 0 0 1\n2 1 2 x3 0 0 0 1\n"), "flight.tum:3: \"x3\" is not a number");
    EXPECT_EQ(tum_complaint("1 1 2\n"), "flight.tum:1: 3 columns, but a TUM line has 8: t x y z qx qy qz qw");
    EXPECT_EQ(tum_complaint("1 1 nan 3 0 0 0 1\n"), "flight.tum:1: \"nan\" is not a finite number");
    EXPECT_EQ(tum_complaint("1 1 2 3 0 0 0 -inf\n"), "flight.tum:1: \"-inf\" is not a finite number");
    EXPECT_EQ(tum_complaint("1 1 2 1e999 0 0 0 1\n"), "flight.tum:1: \"1e999\" is not a number");
    EXPECT_EQ(tum_complaint("1 1 2 3m 0 0 0 1\n"), "flight.tum:1: \"3m\" is not a number");
    EXPECT_THAT(tum_complaint("1 1e12 2 3 0 0 0 1\n"), HasSubstr("flight.tum:1: a coordinate beyond"));
    EXPECT_THAT(tum_complaint("1e300 1 2 3 0 0 0 1\n"), HasSubstr("flight.tum:1: a time of 1e+300 s"));
}

TEST(ReadTum, TimesMustIncrease) {
    EXPECT_EQ(tum_complaint("1 1 2 3 0 0 0 1\n1 1 2 3 0 0 0 1\n"),
              "flight.tum:2: times must increase: 1.000000000 follows 1.000000000");
    EXPECT_THAT(tum_complaint("2 1 2 3 0 0 0 1\n1 1 2 3 0 0 0 1\n"), HasSubstr("times must increase"));
}

TEST(ReadTum, ATimeRoundedTwiceToTheSameIsPassedOverInATruth) {
    std::istringstream stream("1 1 2 3 0 0 0 1\n1 4 5 6 0 0 0 1\n2 7 8 9 0 0 0 1\n");
    const Track track = read_tum(stream, "truth.tum", RepeatedTime::passed_over);
    ASSERT_EQ(track.size(), 2u);
    EXPECT_EQ(track[0].position_m.x(), 1);
    EXPECT_EQ(track[1].position_m.x(), 7);
    std::istringstream back("2 1 2 3 0 0 0 1\n1 1 2 3 0 0 0 1\n");
    EXPECT_THROW(read_tum(back, "truth.tum", RepeatedTime::passed_over), FileError);
}

TEST(ReadPoseLines, TakesPosesWithTheirBoundsAndPassesOverOtherClasses) {
    const Track track = poses("{\"class\":\"VERSION\"}\n" + pose("cart", 1) + pose("cart", 1.5));
    ASSERT_EQ(track.size(), 2u);
    EXPECT_EQ(track[1].time_s, 1.5);
    EXPECT_EQ(track[1].position_m, Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(track[1].horizontal_bound_m, 0.25);
    EXPECT_TRUE(std::isnan(track[1].vertical_bound_m));
}

TEST(ReadPoseLines, ChoosesOneTarget) {
    const std::string both = pose("cart", 1) + pose("person", 1) + pose("cart", 2);
    EXPECT_EQ(poses(both, "cart").size(), 2u);
    EXPECT_EQ(poses(both, "person").size(), 1u);
    EXPECT_EQ(complaint([&] { poses(both); }),
              "poses.jsonl:2: poses of two targets, \"cart\" and \"person\": choose one with --target");
}

TEST(ReadPoseLines, SaysWhichLineIsWrongAndWhy) {
    const auto of = [](const std::string& line) { return complaint([&] { poses(pose("cart", 1) + line + "\n"); }); };
    EXPECT_EQ(of("{\"class\":\"POSE\""), "poses.jsonl:2: not a JSON object");
    EXPECT_EQ(of("{}"), "poses.jsonl:2: a JSON line without a class: POSE lines are expected");
    EXPECT_EQ(of(R"({"class":"POSE","target":"cart"})"), "poses.jsonl:2: a POSE without a time");
    EXPECT_EQ(of(R"({"class":"POSE","target":"cart","time":2,"position_site_m":[1,2]})"),
              "poses.jsonl:2: a POSE without a position_site_m of three numbers");
    EXPECT_THAT(of(pose("cart", 0.5)), HasSubstr("poses.jsonl:2: times must increase"));
}

TEST(ReadEstimate, KnowsTheTwoFormatsApartAndSaysWhatIsMissing) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() / "locus_read_test";
    std::filesystem::create_directories(folder);
    std::ofstream(folder / "a") << "1 1 2 3 0 0 0 1\n";
    std::ofstream(folder / "b") << "\n" << pose("cart", 1);
    std::ofstream(folder / "c") << "# nothing\n";
    EXPECT_EQ(read_estimate(folder / "a").size(), 1u);
    EXPECT_EQ(read_estimate(folder / "b").front().horizontal_bound_m, 0.25);
    EXPECT_THAT(complaint([&] { read_estimate(folder / "c"); }), HasSubstr("c: holds no pose"));
    EXPECT_THAT(complaint([&] { read_estimate(folder / "b", "person"); }), HasSubstr("holds no pose of \"person\""));
    EXPECT_THAT(complaint([&] { read_estimate(folder / "none"); }), HasSubstr("No such file or directory"));
    EXPECT_THAT(complaint([&] { read_estimate(folder); }), HasSubstr("cannot be read: Is a directory"));
    std::filesystem::remove_all(folder);
}

} // namespace
} // namespace locus::evaluate
