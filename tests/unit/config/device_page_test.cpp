// docs/devices.md: every line of configuration that it offers is a good one, and no decoder is missing from it.
#include "load_fixture.h"
#include "tests/support/source_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>

namespace locus {
namespace {

std::string device_page() {
    std::ifstream file(test::source_folder() + "/docs/devices.md");
    return {std::istreambuf_iterator<char>(file), {}};
}

TEST(DevicePage, EveryLineIsGood) {
    const std::string page = device_page();
    const std::regex line{R"(\{name: [^}]*\})"};
    int lines = 0;
    for (auto match = std::sregex_iterator(page.begin(), page.end(), line); match != std::sregex_iterator{}; ++match) {
        const std::string input = std::regex_replace(match->str(), std::regex{R"(\.\.\.)"}, "/dev/serial/by-id/x");
        EXPECT_EQ(problem_of("site: {name: a}\ninputs: [" + input + "]\n"), "") << input;
        ++lines;
    }
    EXPECT_GT(lines, 20);
}

TEST(DevicePage, NoDecoderIsMissing) {
    const std::string page = device_page() + "serial_layout"; // that one has a page of its own
    for (const DecoderRow& row : decoder_table()) EXPECT_NE(page.find(row.name), std::string::npos) << row.name;
}

} // namespace
} // namespace locus
