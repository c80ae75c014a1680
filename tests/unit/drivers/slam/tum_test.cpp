#include "tests/unit/drivers/slam/tum_lines.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <cmath>

namespace locus::slam {
namespace {

using test::Collector;

/// Of ORB-SLAM on fr2_desk, as evo has it.
constexpr std::string_view desk_line =
    "1311868171.331406 0.0144578 0.0064183 -0.0057602 -0.0013450 -0.0102747 -0.0080008 0.9999143";

TEST(Tum, ReadsALine) {
    const auto pose = parse_tum_pose(desk_line);
    ASSERT_TRUE(pose.has_value());
    EXPECT_DOUBLE_EQ(pose->time_s, 1311868171.331406);
    EXPECT_EQ(pose->position, (Vec3{0.0144578, 0.0064183, -0.0057602}));
    EXPECT_EQ(pose->orientation_xyzw, (std::array{-0.0013450, -0.0102747, -0.0080008, 0.9999143}));
    const auto given = tum_decoded(std::string{desk_line} + "\r\n").all<VisualOdometry>();
    ASSERT_EQ(given.size(), 1u);
    EXPECT_EQ(given[0].tag, address(7));
    EXPECT_EQ(given[0].camera, address(7)) << "whoever wears it gives it a name";
    EXPECT_EQ(given[0].segment, 0u);
    EXPECT_EQ(given[0].position_odometry, pose->position);
    EXPECT_NEAR(given[0].orientation_xyzw[3], 0.9999143, 1e-6);
}

TEST(Tum, ACameraMayHaveANameOfItsOwnAndNobodyToWearIt) {
    TumSettings settings;
    settings.camera = address(40);
    const auto given = tum_decoded(at(1), settings).all<VisualOdometry>();
    ASSERT_EQ(given.size(), 1u);
    EXPECT_EQ(given[0].camera, address(40));
    EXPECT_EQ(given[0].tag, no_address);
}

TEST(Tum, BlanksTabsAndCommasPartNumbers) {
    const TumPose expected{1.5, {1, -2, 3e-2}, {0, 0.6, 0, -0.8}};
    for (const char* line : {"1.5 1 -2 3e-2 0 0.6 0 -0.8", "  1.5\t1\t-2   0.03 0 .6 0 -.8 \t",
                             "1.5,1,-2,0.03,0,0.6,0,-0.8", "1.5, 1, -2, 0.03, 0, 0.6, 0, -0.8,"})
        EXPECT_EQ(parse_tum_pose(line), expected) << line;
}

TEST(Tum, ReadsBackWhatItWrites) {
    EXPECT_TRUE(rc::check([](std::int64_t time_us, std::array<std::int32_t, 7> parts) {
        TumPose pose;
        pose.time_s = static_cast<double>(time_us % 9'000'000'000'000'000) * 1e-6;
        for (std::size_t i = 0; i < 3; ++i) pose.position[i] = parts[i] * 1e-7;
        for (std::size_t i = 0; i < 4; ++i) pose.orientation_xyzw[i] = parts[i + 3] * 1e-7;
        std::string line = encode(pose);
        line.pop_back();
        RC_ASSERT(parse_tum_pose(line) == pose);
    }));
}

TEST(Tum, RefusesWhatIsNoPose) {
    for (const char* line : {"1 2 3", "1 0 0 0 0 0 0", "1 0 0 0 0 0 0 1 5", "1 0 0 0 0 0 0 one",
                             "time x y z qx qy qz qw", "1 0 0 0 0 0-0 1", "1 0 0 0 0 0 0 1x", "+1 0 0 0 0 0 0 1"}) {
        const Collector sink = tum_decoded(std::string{line} + "\n");
        EXPECT_EQ(sink.refusals, std::vector<Refusal>{Refusal::malformed}) << line;
        EXPECT_TRUE(sink.items.empty());
    }
    for (const char* line :
         {"1 nan 0 0 0 0 0 1", "nan 0 0 0 0 0 0 1", "1 0 -inf 0 0 0 0 1", "1 0 0 0 0 0 0 nan", "1 0 0 0 0 0 0 0",
          "1 0 0 0 0 0 0 0.98", "1 0 0 0 0.2 0 0 1", "1 0 0 2e6 0 0 0 1", "1403636579763555584 0 0 0 0 0 0 1"}) {
        const Collector sink = tum_decoded(std::string{line} + "\n");
        EXPECT_EQ(sink.refusals, std::vector<Refusal>{Refusal::out_of_range}) << line;
        EXPECT_TRUE(sink.items.empty());
    }
    const Collector sink = tum_decoded(std::string(600, '1') + "\n" + at(1));
    EXPECT_EQ(sink.refusals, std::vector<Refusal>{Refusal::too_long});
    EXPECT_EQ(sink.items.size(), 1u);
}

TEST(Tum, ARoundedAttitudeIsMadeLengthOne) {
    const auto given = tum_decoded("1 0 0 0 0.71 0 0 0.71\n").all<VisualOdometry>();
    ASSERT_EQ(given.size(), 1u);
    EXPECT_DOUBLE_EQ(given[0].orientation_xyzw[0], std::sqrt(0.5));
}

TEST(Tum, RemarksArePassedOver) {
    const Collector sink = tum_decoded("# timestamp tx ty tz qx qy qz qw\n\n \t \n" + at(1) +
                                       "#\n# lost again\n# losting\n# segments\n#segment\n" + at(2));
    EXPECT_TRUE(sink.refusals.empty());
    EXPECT_EQ(sink.frames, 2);
    EXPECT_EQ(sink.all<VisualOdometry>().at(1).segment, 0u);
}

TEST(Tum, ItDoesNotMatterHowLinesAreCut) {
    const std::string text = "# segment 1\n" + at(1) + at(2) + "1 2\n# lost\n" + at(3) + std::string(600, ' ') + '\n' +
                             std::string{desk_line} + "\n" + at(1311868171.4);
    const Collector whole = tum_decoded(text);
    EXPECT_EQ(whole.refusals, (std::vector{Refusal::malformed, Refusal::too_long, Refusal::out_of_range}));
    EXPECT_EQ(whole.items.size(), 4u);
    for (std::size_t size = 1; size < text.size(); ++size) {
        const Collector cut = tum_decoded(text, worn_by_seven(), size);
        EXPECT_EQ(cut.refusals, whole.refusals) << size;
        EXPECT_EQ(cut.frames, whole.frames) << size;
        ASSERT_EQ(cut.items.size(), whole.items.size()) << size;
        EXPECT_EQ(cut.all<VisualOdometry>().back().segment, 2u) << size;
    }
}

} // namespace
} // namespace locus::slam
