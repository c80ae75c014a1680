// A settings file written by an enemy, or by a cat on the keyboard: always an answer, soon, in bounded memory.
#include "config/yaml_tree.h"
#include "load_fixture.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace locus {
namespace {

std::string repeated(std::string_view piece, std::size_t times) {
    std::string text;
    for (std::size_t i = 0; i < times; ++i) text += piece;
    return text;
}

TEST(Hostile, DeepFlowLists) { EXPECT_NE(problem_of(repeated("[", 1'000'000)), ""); }
TEST(Hostile, DeepFlowMaps) { EXPECT_NE(problem_of(repeated("{a: ", 250'000)), ""); }
TEST(Hostile, DeepBlockLists) { EXPECT_NE(problem_of(repeated("- ", 500'000)), ""); }
TEST(Hostile, DeepKeys) { EXPECT_NE(problem_of(repeated("? ", 500'000)), ""); }
TEST(Hostile, ManyKeys) {
    std::string yaml;
    for (int i = 0; i < 50'000; ++i) yaml += fmt::format("k{}: 1\n", i);
    EXPECT_NE(problem_of(yaml).find("too many keys"), std::string::npos);
}
TEST(Hostile, ManyAnchors) {
    std::string yaml = "site:\n  anchors:\n";
    for (int i = 0; i < 15'000; ++i)
        yaml += fmt::format("    - {{name: a{0}, address: {0}, position_site_m: [0, 0, 0]}}\n", i);
    EXPECT_EQ(problem_of(yaml), "3:5: anchors has 15000 items; at most 1024 are allowed");
}
TEST(Hostile, TooManyValues) {
    EXPECT_NE(problem_of("targets: [" + repeated("1,", 300'000) + "]").find("too many values"), std::string::npos);
}
TEST(Hostile, TooLong) {
    EXPECT_EQ(problem_of(std::string(config::max_file_bytes + 1, '#')), "the file is longer than 1048576 bytes");
}
TEST(Hostile, FileWithoutEnd) {
    const auto result = load_settings("/dev/zero");
    EXPECT_FALSE(result.settings);
    EXPECT_EQ(result.problems.size(), 1u);
}
TEST(Hostile, Utf16) {
    EXPECT_NE(problem_of(std::string("\xFF\xFEs\0i\0", 6)).find("not plain UTF-8"), std::string::npos);
}
TEST(Hostile, LongTextIsCutInTheMessage) {
    const auto problem = problem_of("fusion: {rate_hz: " + std::string(100'000, 'x') + "}");
    EXPECT_LT(problem.size(), 200u);
}

} // namespace
} // namespace locus
