#include "drivers/line_splitter.h"

#include "tests/unit/drivers/collector.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <string>

namespace locus {
namespace {

using Line = std::pair<std::string, std::int64_t>;

struct Splitting {
    LineSplitter splitter;
    std::vector<Line> lines;
    int too_long = 0;

    void feed(std::string_view text, std::int64_t time_ns = 0, std::int64_t byte_time_ns = 0) {
        splitter.feed(
            test::bytes_packet(text, timestamp_from_ns(time_ns), Duration{byte_time_ns}),
            [&](std::string_view line, Timestamp complete) { lines.emplace_back(line, to_ns(complete)); },
            [&] { ++too_long; });
    }
};

TEST(LineSplitter, TakesOffTheEndOfLineAndSkipsEmptyLines) {
    Splitting s;
    s.feed("one\r\ntwo\n\r\n\nthr");
    s.feed("ee\r");
    s.feed("\nrest");
    EXPECT_EQ(s.lines, (std::vector<Line>{{"one", 0}, {"two", 0}, {"three", 0}}));
}

TEST(LineSplitter, StampsEachLineWithTheTimeItWasComplete) {
    Splitting s;
    s.feed("a\nbb\nccc\nd", 1000, 10);
    EXPECT_EQ(s.lines, (std::vector<Line>{{"a", 920}, {"bb", 950}, {"ccc", 990}}));
}

TEST(LineSplitter, GivesUpATooLongLineOnceAndGoesOnAfterIt) {
    Splitting s;
    const std::string longest(LineSplitter::capacity, 'x');
    s.feed(longest + "\n");
    EXPECT_EQ(s.too_long, 0);
    s.feed(longest + longest + "xx\nnext\n");
    EXPECT_EQ(s.too_long, 1);
    EXPECT_EQ(s.lines, (std::vector<Line>{{longest, 0}, {"next", 0}}));
}

TEST(LineSplitter, ResetForgetsTheHalfLine) {
    Splitting s;
    s.feed("half");
    s.splitter.reset();
    s.feed("whole\n");
    EXPECT_EQ(s.lines, (std::vector<Line>{{"whole", 0}}));
}

TEST(LineSplitter, HowTheBytesAreCutDoesNotMatter) {
    EXPECT_TRUE(rc::check([] {
        const auto letter = rc::gen::element('a', 'b', '\r', '\n');
        const auto chunks = *rc::gen::container<std::vector<std::string>>(rc::gen::container<std::string>(letter));
        Splitting whole, cut;
        std::string text;
        for (const std::string& chunk : chunks) cut.feed(chunk), text += chunk;
        whole.feed(text);
        RC_ASSERT(whole.lines == cut.lines);
    }));
}

} // namespace
} // namespace locus
