// systemd/60-locusd.rules: every line is one that udev understands (Debian 12 has no `udevadm verify`), no jump leads
// nowhere, and the device page names the families that the rules name.
#include "tests/support/source_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>

namespace locus {
namespace {

std::string text_of(const std::string& path) {
    std::ifstream file(test::source_folder() + path);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> udev_lines() {
    std::vector<std::string> lines;
    std::ifstream file(test::source_folder() + "/systemd/60-locusd.rules");
    for (std::string line; std::getline(file, line);)
        if (!line.empty() && line[0] != '#') lines.push_back(line);
    return lines;
}

/// What stands in quotes behind `key`, in every rule that has it.
std::set<std::string> values_of(const std::string& key) {
    std::set<std::string> values;
    const std::regex pattern{key + "=*\"([^\"]*)\""};
    for (const std::string& line : udev_lines())
        for (auto m = std::sregex_iterator(line.begin(), line.end(), pattern); m != std::sregex_iterator{}; ++m)
            values.insert((*m)[1]);
    return values;
}

TEST(UdevRules, EveryLineIsOneThatUdevUnderstands) {
    const std::regex rule{
        R"re(((ACTION|SUBSYSTEM|DRIVER|ATTRS?\{\w+\}|ENV\{\w+\})(==|!=)"[^"]*"(, (?=.)|$)|)re"
        R"re((ATTR\{\w+\}|ENV\{\w+\}|GOTO|LABEL|GROUP|MODE|IMPORT\{builtin\})="[^"]*"(, (?=.)|$)|SYMLINK\+="locus/[^"]+"$)+)re"};
    const auto lines = udev_lines();
    EXPECT_GT(lines.size(), 15u);
    for (const std::string& line : lines) EXPECT_TRUE(std::regex_match(line, rule)) << line;
}

TEST(UdevRules, EveryJumpLeadsSomewhere) {
    EXPECT_EQ(values_of("GOTO"), values_of("LABEL"));
    EXPECT_EQ(values_of("GOTO").size(), 2u);
}

TEST(UdevRules, TheDevicePageNamesEveryFamily) {
    const std::string page = text_of("/docs/devices.md");
    const auto families = values_of(R"(ENV\{LOCUS_FAMILY\})");
    EXPECT_GT(families.size(), 8u);
    for (const std::string& family : families)
        EXPECT_TRUE(family == "?*" || page.find("`" + family) != std::string::npos) << family;
}

} // namespace
} // namespace locus
