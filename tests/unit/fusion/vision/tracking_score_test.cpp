// The measures of trackers on cases that can be counted by hand.
#include "tests/replay/tracking_score.h"

#include <gtest/gtest.h>

namespace locus::test {
namespace {

/// A box of 10 x 20 at x.
NamedBox at_x(std::uint32_t id, float x_px) { return {id, {x_px, 0, 10, 20}}; }

TEST(TrackingScore, AllRightIsOne) {
    TrackingScorer scorer;
    for (int i = 0; i < 5; ++i) scorer.add({at_x(1, 0), at_x(2, 50)}, {at_x(7, 0), at_x(8, 50)});
    const auto score = scorer.score();
    EXPECT_EQ(score.mota(), 1);
    EXPECT_EQ(score.idf1(), 1);
    EXPECT_EQ(score.switches, 0u);
}

TEST(TrackingScore, MissedAndFalseAndSwitched) {
    TrackingScorer scorer;
    scorer.add({at_x(1, 0)}, {at_x(7, 0)});
    scorer.add({at_x(1, 0)}, {});                        // missed
    scorer.add({at_x(1, 0)}, {at_x(7, 0), at_x(9, 90)}); // one false
    scorer.add({at_x(1, 0)}, {at_x(8, 0)});              // a switch
    scorer.add({at_x(1, 0)}, {at_x(8, 6)});              // IoU 4 / 16: missed and false
    const auto score = scorer.score();
    EXPECT_EQ(score.persons, 5u);
    EXPECT_EQ(score.boxes, 5u);
    EXPECT_EQ(score.matched, 3u);
    EXPECT_EQ(score.switches, 1u);
    EXPECT_DOUBLE_EQ(score.mota(), 1 - (2 + 2 + 1) / 5.0);
    EXPECT_DOUBLE_EQ(score.recall(), 0.6);
    EXPECT_DOUBLE_EQ(score.precision(), 0.6);
    EXPECT_DOUBLE_EQ(score.idf1(), 2 * 2 / 10.0) << "track 7 is the person's, in two frames";
}

TEST(TrackingScore, APairThatStillOverlapsIsKept) {
    TrackingScorer scorer;
    scorer.add({at_x(1, 0)}, {at_x(7, 0)});
    scorer.add({at_x(1, 0)}, {at_x(7, 3), at_x(8, 0)}); // 8 overlaps better, 7 by 7 / 13 still enough
    EXPECT_EQ(scorer.score().switches, 0u);
}

TEST(TrackingScore, AMissBetweenIsStillASwitch) {
    TrackingScorer scorer;
    scorer.add({at_x(1, 0)}, {at_x(7, 0)});
    scorer.add({at_x(1, 0)}, {});
    scorer.add({at_x(1, 0)}, {at_x(8, 0)});
    EXPECT_EQ(scorer.score().switches, 1u);
}

TEST(TrackingScore, IdentitiesAreAssignedOverAllFrames) {
    // Person 1 has track 7 for 2 frames and 8 for 3; person 2 has 8 for 4 frames. 8 goes to person 2, so 7 is left
    // for 1.
    TrackingScorer scorer;
    for (int i = 0; i < 4; ++i) scorer.add({at_x(2, 0)}, {at_x(8, 0)});
    for (int i = 0; i < 3; ++i) scorer.add({at_x(1, 0)}, {at_x(8, 0)});
    for (int i = 0; i < 2; ++i) scorer.add({at_x(1, 0)}, {at_x(7, 0)});
    const auto score = scorer.score();
    EXPECT_EQ(score.agreed, 6u);
    EXPECT_DOUBLE_EQ(score.idf1(), 12 / 18.0);
}

} // namespace
} // namespace locus::test
