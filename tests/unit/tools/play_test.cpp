// locus play: every byte into its device, in order, and a sentence for what cannot be.
#include "tests/unit/drivers/transport_fixture.h"
#include "tests/unit/tools/fake_daemon.h"

#include <gmock/gmock.h>

#include <fstream>

namespace locus {
namespace {

using testing::HasSubstr;

class PlayTest : public testing::Test {
  protected:
    std::string path(const std::string& name) const { return room_ / name; }

    std::string config(const std::string& transport, const std::string& more = "") const {
        std::ofstream{path("c.yaml")} << "inputs:\n  - {name: uwb, transport: " + transport + ", path: " + path("tty") +
                                             ", decoder: trek1000}\n" + more;
        return path("c.yaml");
    }
    std::string recording(const std::string& text) const {
        std::ofstream{path("r.log")} << text;
        return path("r.log");
    }
    static CommandResult play(std::vector<std::string> words) {
        words.insert(words.begin(), "play");
        return run_locus({add_play}, std::move(words));
    }

    /// What a reader of the device gets while the recording is played.
    std::string read_while_playing(const std::string& transport, const std::string& log, CommandResult& result) const {
        const auto device = testing_transport::make_transport(transport, {{"path", path("tty")}});
        testing_transport::KeepingSink received;
        std::jthread reader{[&](const std::stop_token& stop) {
            while (!stop.stop_requested() && !device->open()) std::this_thread::yield();
            while (!stop.stop_requested())
                if (device->read(received, std::chrono::milliseconds{10}) != ReadStatus::ok) return;
        }};
        result = play({log, "--config", config(transport), "--speed", "100"});
        reader.request_stop();
        reader.join();
        return received.text;
    }

    test::TemporaryFolder room_;
};

TEST_F(PlayTest, EveryByteInItsOrderIntoAPseudoTerminalAndAPipe) {
    const auto log = recording("(5.0) uwb serial#6D6320\n(5.1) can0 123#11\n(5.2) uwb serial#30310D0A\nwhat?\n");
    for (const char* transport : {"pty", "fifo"}) {
        CommandResult result;
        EXPECT_EQ(read_while_playing(transport, log, result), "mc 01\r\n") << transport;
        EXPECT_EQ(result.exit_code, exit_yes);
        EXPECT_THAT(result.out, HasSubstr("2 packets in "));
        EXPECT_THAT(result.err, HasSubstr("1 lines of 'can0' left out: no enabled input has this name"));
        EXPECT_THAT(result.err, HasSubstr("line 4 left out: "));
    }
}

TEST_F(PlayTest, ADeviceThatCannotBeFedIsASentence) {
    const auto result = play({recording("(5.0) uwb serial#41\n"), "--config", config("serial")});
    EXPECT_EQ(result.exit_code, exit_usage);
    EXPECT_THAT(result.err, HasSubstr("input 'uwb': transport serial cannot be fed from here: use pty, fifo or can"));
}

TEST_F(PlayTest, WhatIsNotThereIsASentence) {
    const auto result = play({path("none.log"), "--config", config("pty")});
    EXPECT_EQ(result.exit_code, exit_usage);
    EXPECT_THAT(result.err, HasSubstr("none.log' cannot be read, or is empty"));
    std::ofstream{path("e.yaml")} << "log: {level: info}\n";
    EXPECT_THAT(play({recording("(5.0) uwb serial#41\n"), "--config", path("e.yaml")}).err,
                HasSubstr("no enabled input to play into"));
}

} // namespace
} // namespace locus
