// The quick way into a recording's line against nlohmann's: whatever the quick one takes, the slow one reads alike.
#include "drivers/recording/json_fields.h"
#include "drivers/recording/measurement_json.h"
#include "tests/unit/drivers/recording/measurement_gen.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>
#include <array>
#include <random>

namespace locus {
namespace {

bool is_plain(std::string_view line) {
    JsonFields fields;
    return plain_json_fields(line, fields);
}

/// Empty when both say the same, or the quick one leaves it to the other.
std::string disagreement(const std::string& line) {
    JsonFields plain, judged;
    std::string error;
    if (!plain_json_fields(line, plain)) return {};
    if (!parse_json_fields(line, judged, error)) return error.ends_with("is there twice") ? "" : error;
    if (plain.fields.size() != judged.fields.size()) return "another number of fields";
    for (std::size_t i = 0; i < plain.fields.size(); ++i) {
        const JsonField &a = plain.fields[i], &b = judged.fields[i];
        if (a.name != b.name || a.shape != b.shape) return std::string{a.name};
        if (!std::ranges::equal(plain.of(a), judged.of(b))) return "values of " + std::string{a.name};
    }
    return {};
}

TEST(PlainFields, ReadsWhatIsWrittenAsTheOtherDoes) {
    EXPECT_TRUE(rc::check([] {
        const std::string line = to_json_line(test::random_measurement());
        RC_CLASSIFY(is_plain(line)); // all but numbers beyond 1e99
        RC_ASSERT(disagreement(line).empty());
    }));
}

TEST(PlainFields, LeavesToTheOtherWhatIsNotPlain) {
    for (const char* line : {"",
                             "{}",
                             "[1]",
                             "{\"a\":1",
                             "{\"a\":1}}",
                             "{\"a\":1}x",
                             "{\"a\":01}",
                             "{\"a\":1.}",
                             "{\"a\":.5}",
                             "{\"a\":+1}",
                             "{\"a\":-}",
                             "{\"a\":1e}",
                             "{\"a\":1e999}",
                             "{\"a\":-0}",
                             "{\"a\":null}",
                             "{\"a\":true}",
                             "{\"a\":[]}",
                             "{\"a\":[1,]}",
                             "{\"a\":[\"1\"]}",
                             "{\"a\":[[1]]}",
                             "{\"a\":{\"b\":1}}",
                             "{\"a\":\"\\n\"}",
                             "{\"a\":\"\xc3\xa4\"}",
                             "{\"a\":\"",
                             "{a:1}",
                             "{\"a\" 1}",
                             "{\"a\":1,}",
                             "{\"a\":0x1}",
                             "{\"a\":1 2}"})
        EXPECT_FALSE(is_plain(line)) << line;
    EXPECT_FALSE(is_plain("{\"a\":" + std::string(65, '1') + "}")) << "it might be too large for a double";
    for (const char* line :
         {"{\"a\":1}", " { \"a\" : [ 1 , -2.5e-07 ] , \"b\" : \"x\" } ", "{\"a\":-0.0}", "{\"a\":0}", "{\"a\":10E+2}"})
        EXPECT_TRUE(is_plain(line)) << line;
}

// A hundred thousand lines with characters changed, left out and put in; the seed is stated.
TEST(PlainFields, NeverReadsADamagedLineOtherwise) {
    std::mt19937 random{7};
    const std::string good =
        R"({"t": 12.5, "class": "IMU", "input": 0, "sequence": 3, "tag": 1, "specific_force_mps2": [0.5, -1e-3, 9.81]})";
    constexpr std::string_view marks = "{}[]\":,.-+eE0123456789 \\/abtnu\t\n\x01\x7f\xc3";
    const auto below = [&](std::size_t limit) {
        return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random);
    };
    std::size_t taken = 0;
    for (int n = 0; n < 100'000; ++n) {
        std::string line = good;
        for (std::size_t changes = 1 + below(3); changes > 0; --changes) {
            const std::size_t at = below(line.size());
            const char mark = marks[below(marks.size())];
            const std::size_t how = below(3);
            if (how == 0)
                line[at] = mark;
            else if (how == 1)
                line.insert(at, 1, mark);
            else
                line.erase(at, 1);
        }
        taken += is_plain(line);
        ASSERT_EQ(disagreement(line), "") << line;
    }
    EXPECT_GT(taken, 5'000U) << "the test would say nothing";
    EXPECT_LT(taken, 95'000U);
}

} // namespace
} // namespace locus
