// locus simulate as it is typed.
#include "tests/support/source_folder.h"
#include "tests/support/temporary_folder.h"
#include "tools/command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace locus {
namespace {

using ::testing::HasSubstr;

class SimulateCommand : public ::testing::Test {
  protected:
    test::TemporaryFolder room;
    const std::string demo = test::source_folder() + "/config/examples/demo-scenario.yaml";
    std::string out, err;

    std::string at(const std::string& name) const { return room / name; }

    int run(const std::string& arguments) {
        CLI::App app;
        int exit_code = exit_yes;
        add_simulate(app, exit_code);
        ::testing::internal::CaptureStdout();
        ::testing::internal::CaptureStderr();
        app.parse("simulate " + arguments);
        out = ::testing::internal::GetCapturedStdout();
        err = ::testing::internal::GetCapturedStderr();
        return exit_code;
    }

    static std::string read(const std::string& path) {
        std::ostringstream text;
        text << std::ifstream(path).rdbuf();
        return text.str();
    }
};

TEST_F(SimulateCommand, FastRecordingIsTheSameEveryTime) {
    const std::string arguments = demo + " --fast --duration 3 --record ";
    ASSERT_EQ(run(arguments + at("a.log") + " --truth " + at("a.tum")), exit_yes) << err;
    ASSERT_EQ(run(arguments + at("b.log")), exit_yes);
    ASSERT_EQ(run(arguments + at("c.log") + " --seed 77"), exit_yes);
    EXPECT_TRUE(read(at("a.log")).starts_with("(1.000000) uwb serial#6D63"));
    EXPECT_TRUE(read(at("a.log")) == read(at("b.log")));
    EXPECT_FALSE(read(at("a.log")) == read(at("c.log")));
    for (const char* name : {"a-anna.tum", "a-bruno.tum", "a-cart.tum"})
        EXPECT_TRUE(read(at(name)).starts_with("1.000000000 ")) << name;
}

TEST_F(SimulateCommand, RealTimeMakesTheDeviceAndTheSameBytes) {
    const auto data_of = [](const std::string& recording) {
        std::string data;
        std::istringstream lines(recording);
        for (std::string line; std::getline(lines, line);) data += line.substr(line.find(") ")) + "\n";
        return data;
    };
    std::string scenario = read(demo);
    scenario.replace(scenario.find("uwb.pty"), 7, at("uwb.pty"));
    std::ofstream(at("s.yaml")) << scenario;
    ASSERT_EQ(run(at("s.yaml") + " --duration 0.3 --record " + at("live.log")), exit_yes) << err;
    EXPECT_THAT(err, HasSubstr("packets were lost: nobody read them"));
    ASSERT_EQ(run(at("s.yaml") + " --fast --duration 0.3 --record " + at("fast.log")), exit_yes);
    EXPECT_FALSE(std::filesystem::exists(at("uwb.pty")));
    EXPECT_EQ(data_of(read(at("live.log"))), data_of(read(at("fast.log"))));
}

TEST_F(SimulateCommand, PrintsTheConfiguration) {
    ASSERT_EQ(run(demo + " --print-config --socket /tmp/x.sock"), exit_yes);
    EXPECT_THAT(out, HasSubstr("decoder: \"trek1000\""));
    EXPECT_THAT(out, HasSubstr("/tmp/x.sock"));
}

TEST_F(SimulateCommand, SaysWhatIsWrong) {
    EXPECT_EQ(run("/nowhere.yaml"), exit_usage);
    EXPECT_THAT(err, HasSubstr("/nowhere.yaml"));
    EXPECT_EQ(run(demo + " --fast --duration 1"), exit_usage);
    EXPECT_THAT(err, HasSubstr("--record"));
    EXPECT_EQ(run(demo + " --fast --record " + at("x.log")), exit_usage);
    EXPECT_THAT(err, HasSubstr("--duration"));
    EXPECT_EQ(run(demo + " --fast --duration 1 --record /nowhere/x.log"), exit_usage);
    EXPECT_THAT(err, HasSubstr("cannot write '/nowhere/x.log'"));
    std::ofstream(at("bad.yaml")) << "targets: 5\n";
    EXPECT_EQ(run(at("bad.yaml")), exit_usage);
    EXPECT_THAT(err, HasSubstr("bad.yaml:1:10: "));
}

} // namespace
} // namespace locus
