// locus record: what it writes is what came, and it never destroys a recording.
#include "drivers/recording/log_file.h"
#include "drivers/recording/log_line.h"
#include "tests/support/temporary_folder.h"
#include "tools/command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <thread>

namespace locus {
namespace {

using testing::HasSubstr;

std::vector<std::string> lines_of(const std::string& path) {
    std::ifstream file{path};
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
}

class RecordTest : public testing::Test {
  protected:
    std::string path(const std::string& name) const { return folder_ / name; }

    /// A site with one input that plays `recording` as fast as it can.
    std::string config(const std::string& recording) const {
        std::ofstream{path("played.log")} << recording;
        std::ofstream{path("hall.yaml")} << "inputs:\n  - name: hall\n    transport: recording\n    decoder: trek1000\n"
                                            "    path: "
                                         << path("played.log") << "\n    speed: 0\n";
        return path("hall.yaml");
    }

    static int run(const std::string& arguments) {
        CLI::App app;
        int exit_code = -1;
        add_record(app, exit_code);
        app.parse(arguments);
        return exit_code;
    }

    test::TemporaryFolder folder_;
};

TEST_F(RecordTest, WritesWhatCame) {
    const std::string yaml = config("(5.0) a serial#6D63\n(5.000123) a serial#0D0A\n");
    ASSERT_EQ(run("record --config " + yaml + " -o " + path("out.log")), exit_yes);
    const auto lines = lines_of(path("out.log"));
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_THAT(lines[0], HasSubstr("# recording begun"));
    std::string error;
    const auto first = from_log_line(lines[1], error), second = from_log_line(lines[2], error);
    ASSERT_TRUE(first && second) << error;
    EXPECT_EQ(first->input, "hall");
    EXPECT_EQ(second->data, (std::vector<std::uint8_t>{'\r', '\n'}));
    EXPECT_EQ(second->time - first->time, std::chrono::microseconds{123});
}

TEST_F(RecordTest, KeepsAFileThatIsThere) {
    const std::string yaml = config("(5.0) a serial#41\n");
    std::ofstream{path("out.log")} << "precious\n";
    EXPECT_EQ(run("record --config " + yaml + " -o " + path("out.log")), exit_usage);
    EXPECT_EQ(lines_of(path("out.log")), std::vector<std::string>{"precious"});
    EXPECT_EQ(run("record --force --config " + yaml + " -o " + path("out.log")), exit_yes);
    EXPECT_EQ(lines_of(path("out.log")).size(), 2u);
}

TEST_F(RecordTest, NothingCameIsNoSuccess) {
    const std::string yaml = config("# an empty recording\n");
    EXPECT_EQ(run("record --seconds 0.05 --config " + yaml + " -o " + path("out.log")), exit_no);
}

TEST_F(RecordTest, ABadConfigurationOpensNothing) {
    EXPECT_EQ(run("record --config " + path("none.yaml") + " -o " + path("out.log")), exit_usage);
    EXPECT_FALSE(std::filesystem::exists(path("out.log")));
}

TEST_F(RecordTest, LinesOfManyThreadsStayWhole) {
    LogFile file;
    std::string error;
    ASSERT_TRUE(file.open(path("out.log"), false, error)) << error;
    const auto record = [&](std::string name) {
        LogTap tap{name, file};
        const std::vector<std::uint8_t> data(200, 0x55);
        for (int i = 0; i < 500; ++i) {
            Packet packet;
            packet.data = data;
            tap.packet(packet);
        }
    };
    {
        std::jthread a{record, "a"}, b{record, "b"};
    }
    ASSERT_TRUE(file.flush());
    const auto lines = lines_of(path("out.log"));
    EXPECT_EQ(lines.size(), 1001u);
    for (const auto& line : lines) EXPECT_TRUE(line.starts_with('#') || from_log_line(line, error)) << line;
}

TEST_F(RecordTest, AFullDiskIsSeen) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    LogFile file;
    std::string error;
    ASSERT_TRUE(file.open("/dev/full", true, error)) << error;
    EXPECT_FALSE(file.flush());
}

} // namespace
} // namespace locus
