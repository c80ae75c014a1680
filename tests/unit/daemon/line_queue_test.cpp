#include "daemon/socket/line_queue.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <sstream>

namespace locus {
namespace {

OpenLine pose(int number) { return std::make_shared<const std::string>("{\"n\":" + std::to_string(number)); }

std::string drain(LineQueue& queue, std::size_t step = 1000) {
    std::string all;
    while (!queue.empty()) {
        const auto bytes = queue.front().substr(0, step);
        all += bytes;
        queue.written(bytes.size());
    }
    return all;
}

TEST(LineQueue, KeepsTheOrderAndEndsEachLine) {
    LineQueue queue{8};
    queue.push_answer("a\n");
    queue.push_pose(pose(1));
    queue.push_answer("b\n");
    EXPECT_EQ(drain(queue, 3), "a\n{\"n\":1}\nb\n");
    EXPECT_TRUE(queue.empty());
}

TEST(LineQueue, TheOldestPosesAreLostAndTheNextOneSaysHowMany) {
    LineQueue queue{2};
    queue.push_answer("a\n");
    for (int i = 1; i <= 5; ++i) queue.push_pose(pose(i));
    EXPECT_EQ(queue.dropped(), 3u);
    EXPECT_EQ(drain(queue), "a\n{\"n\":4,\"dropped\":3}\n{\"n\":5}\n");
}

TEST(LineQueue, ALineHalfWrittenIsFinished) {
    LineQueue queue{1};
    queue.push_pose(pose(1));
    queue.written(queue.front().substr(0, 2).size());
    queue.push_pose(pose(2));
    queue.push_pose(pose(3));
    EXPECT_EQ(drain(queue), "n\":1}\n{\"n\":3,\"dropped\":1}\n");
}

// Whatever comes and however little is written at a time: no answer is lost, poses keep their order, and the numbers
// told add up to the poses that are missing.
RC_GTEST_PROP(LineQueue, NothingIsLostUntold, ()) {
    const auto capacity = *rc::gen::inRange<std::size_t>(1, 6);
    const auto events = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 12));
    LineQueue queue{capacity};
    std::string all;
    int poses = 0, answers = 0;
    for (const int event : events) {
        if (event < 6)
            queue.push_pose(pose(++poses));
        else if (event < 8)
            queue.push_answer("{\"answer\":" + std::to_string(++answers) + "}\n");
        else if (!queue.empty()) {
            const auto bytes = queue.front().substr(0, static_cast<std::size_t>(event) - 7);
            all += bytes;
            queue.written(bytes.size());
        }
        RC_ASSERT(queue.poses() <= capacity);
    }
    queue.push_pose(pose(++poses)); // so that the last loss is told as well
    all += drain(queue);
    std::istringstream lines{all};
    int seen_pose = 0, seen_answer = 0;
    for (std::string line; std::getline(lines, line);) {
        int number = 0, lost = 0;
        if (std::sscanf(line.c_str(), "{\"answer\":%d}", &number) == 1)
            RC_ASSERT(number == ++seen_answer);
        else {
            RC_ASSERT(std::sscanf(line.c_str(), "{\"n\":%d,\"dropped\":%d}", &number, &lost) >= 1);
            RC_ASSERT(number == seen_pose + lost + 1);
            seen_pose = number;
        }
    }
    RC_ASSERT(seen_pose == poses);
    RC_ASSERT(seen_answer == answers);
}

} // namespace
} // namespace locus
