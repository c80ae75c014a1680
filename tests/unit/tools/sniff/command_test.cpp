// locus sniff as it is typed: on pseudo-terminals, pipes, sockets, recordings and files.
#include "config/load.h"
#include "drivers/recording/log_line.h"
#include "tests/examples/decoder_example.h"
#include "tests/support/fake_device.h"
#include "tests/support/tcp_server.h"
#include "tests/unit/tools/fake_daemon.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <thread>

namespace locus {
namespace {

using nlohmann::json;
using testing::HasSubstr;

CommandResult sniff(std::vector<std::string> words) {
    words.insert(words.begin(), "sniff");
    return run_locus({add_sniff}, std::move(words));
}

const examples::DecoderExample& trek() {
    return *std::ranges::find(examples::all(), "trek1000", &examples::DecoderExample::decoder);
}

std::string text_of(const examples::Chunk& chunk) { return {chunk.begin(), chunk.end()}; }

std::string all_lines() {
    std::string text;
    for (const auto& chunk : trek().chunks) text += text_of(chunk);
    return text;
}

/// Says the example's lines again and again until it goes away.
template <class Send>
std::jthread talking(const Send& send) {
    return std::jthread{[send](const std::stop_token& stop) {
        for (std::size_t i = 0; !stop.stop_requested(); ++i) {
            send(text_of(trek().chunks[i % trek().chunks.size()]));
            std::this_thread::sleep_for(std::chrono::milliseconds{5});
        }
    }};
}

class SniffCommand : public testing::Test {
  protected:
    std::string write(const std::string& name, const std::string& bytes) const {
        std::ofstream{folder_ / name, std::ios::binary} << bytes;
        return folder_ / name;
    }
    /// The lines of two inputs, one of them CAN.
    std::string recording() const {
        std::string text = "# recording\n";
        const CanFrame on_bus{0x340, 8, {1, 2, 3, 4, 5, 6, 7, 0}};
        Packet frame = on_bus.packet({});
        for (int i = 0; i < 20; ++i) {
            Packet packet;
            packet.time = frame.time = timestamp_from_s(5 + 0.1 * i);
            packet.data = trek().chunks[static_cast<std::size_t>(i)];
            text += to_log_line("hall", packet) + "\n" + to_log_line("bus", frame) + "\n";
        }
        return write("two.log", text);
    }
    std::string config(const std::string& device) const {
        return write("hall.yaml",
                     "inputs:\n  - {name: hall, transport: pty, path: " + device + ", decoder: trek1000}\n");
    }

    test::TemporaryFolder folder_;
};

TEST_F(SniffCommand, RecognisesAFileOfBytesAndGivesWhatToType) {
    const auto result = sniff({write("bytes.bin", all_lines())});
    EXPECT_EQ(result.exit_code, exit_yes) << result.err;
    EXPECT_THAT(result.out, HasSubstr("This is trek1000"));
    EXPECT_THAT(result.out, HasSubstr(": sure, "));
    std::string yaml = result.out.substr(result.out.find("  inputs:"));
    EXPECT_TRUE(load_settings_text(yaml, "pasted").settings) << yaml;
}

TEST_F(SniffCommand, WhatToTypeIsGoodForEveryDecoder) {
    for (const auto& example : examples::all()) {
        if (!find_decoder(example.decoder)->options.lists.empty()) continue; // layouts
        std::string log;
        for (std::size_t i = 0; i < example.chunks.size() + example.frames.size(); ++i) {
            Packet packet = example.frames.empty() ? Packet{} : example.frames[i].packet({});
            packet.time = timestamp_from_s(0.2 * static_cast<double>(i));
            if (example.frames.empty())
                packet.data = example.chunks[i];
            else
                packet.time = timestamp_from_s(0.001 * static_cast<double>(i));
            log += to_log_line("it", packet) + "\n";
        }
        const auto answer = json::parse(sniff({write("it.log", log), "--json"}).out);
        ASSERT_EQ(answer["winners"].size(), 1u) << example.decoder;
        EXPECT_EQ(answer["winners"][0]["decoder"], example.decoder);
        const auto yaml = answer["winners"][0]["yaml"].get<std::string>();
        const auto loaded = load_settings_text(yaml, "pasted");
        EXPECT_TRUE(loaded.settings) << yaml << to_string(loaded.problems.front());
    }
}

TEST_F(SniffCommand, ReadsARecordingOfSeveralInputs) {
    const std::string log = recording();
    EXPECT_THAT(sniff({log}).err, HasSubstr("holds several inputs: say which with --input, one of bus, hall"));
    EXPECT_THAT(sniff({log, "--input", "yard"}).err, HasSubstr("no input 'yard', but bus, hall"));
    EXPECT_EQ(json::parse(sniff({log, "--input", "hall", "--json"}).out)["winners"][0]["decoder"], "trek1000");
    const auto bus = sniff({log, "--input", "bus"});
    EXPECT_THAT(bus.out, testing::ContainsRegex("340 +20 +10\\.0 +8 +0-7 always 01 02"));
    EXPECT_THAT(sniff({log, "--input", "bus", "--decoder", "trek1000"}).out, HasSubstr("0 frames"));
}

TEST_F(SniffCommand, ListsTheFramesOfAPseudoTerminal) {
    const test::FakeDevice device{folder_ / "tty"};
    const auto talk = talking([&](const std::string& line) { device.send(line); });
    const auto result = sniff({folder_ / "tty", "--decoder", "trek1000", "--count", "5"});
    EXPECT_EQ(result.exit_code, exit_yes) << result.err;
    EXPECT_THAT(result.out, HasSubstr("RANGE anchor 0 tag 0 range_m 1.26"));
    EXPECT_THAT(result.out, HasSubstr("5 frames"));
}

TEST_F(SniffCommand, FindsOutWhatIsOnAPseudoTerminal) {
    const test::FakeDevice device{folder_ / "tty"};
    const auto talk = talking([&](const std::string& line) { device.send(line); });
    const auto result = sniff({folder_ / "tty", "--seconds", "0.5"});
    EXPECT_EQ(result.exit_code, exit_yes) << result.err;
    EXPECT_THAT(result.out, HasSubstr("This is trek1000"));
    EXPECT_THAT(result.out, HasSubstr("transport: pty\n      path: \"" + (folder_ / "tty") + "\""));
    EXPECT_THAT(sniff({folder_ / "tty", "--baud", "9600"}).err, HasSubstr("has no baud rate"));
}

TEST_F(SniffCommand, TakesAnInputOfAConfiguration) {
    const test::FakeDevice device{folder_ / "tty"};
    const std::string yaml = config(folder_ / "tty");
    const auto talk = talking([&](const std::string& line) { device.send(line); });
    const auto result = sniff({"hall", "--config", yaml, "--count", "2", "--json"});
    EXPECT_EQ(result.exit_code, exit_yes) << result.err;
    EXPECT_EQ(json::parse(result.out.substr(0, result.out.find('\n')))["measurements"][0]["class"], "RANGE");
    EXPECT_THAT(sniff({"yard", "--config", yaml}).err, HasSubstr("no input of"));
    EXPECT_THAT(sniff({recording(), "--config", yaml, "--input", "hall"}).out, HasSubstr("20 frames"));
}

TEST_F(SniffCommand, ReadsTcp) {
    const test::TcpServer server;
    const auto talk = talking([&](const std::string& line) { server.send(line); });
    const auto result = sniff({"tcp:127.0.0.1:" + std::to_string(server.port()), "--seconds", "0.5"});
    EXPECT_EQ(result.exit_code, exit_yes) << result.err;
    EXPECT_THAT(result.out, HasSubstr("host: \"127.0.0.1\""));
    EXPECT_EQ(sniff({"tcp:nowhere"}).exit_code, exit_usage);
}

TEST_F(SniffCommand, APortThatSomebodyHasIsLeftToHim) {
    const test::FakeDevice device{folder_ / "tty"};
    const auto pty = find_transport("pty");
    const auto settings = pty->options.make();
    pty->options.rows[0].set(settings.get(), folder_ / "tty");
    const auto holder = pty->make(settings.get());
    ASSERT_TRUE(holder->open());
    const auto result = sniff({folder_ / "tty"});
    EXPECT_EQ(result.exit_code, exit_usage);
    EXPECT_THAT(result.err, HasSubstr("is in use by another program"));
    EXPECT_THAT(result.err, HasSubstr("locusd --record hall.log"));
}

TEST_F(SniffCommand, OnlyListensUnlessItIsToldToAsk) {
    const test::FakeDevice device{folder_ / "tty"};
    const auto silent = sniff({folder_ / "tty", "--decoder", "dwm1001_tlv", "--seconds", "0.3"});
    EXPECT_EQ(silent.exit_code, exit_no);
    EXPECT_THAT(silent.err, HasSubstr("add --ask"));
    const auto asked = sniff({folder_ / "tty", "--decoder", "dwm1001_tlv", "--seconds", "0.3", "--ask"});
    EXPECT_EQ(device.received().substr(0, 2), std::string("\x0c\0", 2)) << "and nothing before";
}

TEST_F(SniffCommand, SaysWhatToTypeInstead) {
    const auto error = [&](std::vector<std::string> words) {
        const auto result = sniff(std::move(words));
        EXPECT_EQ(result.exit_code, exit_usage);
        return result.err;
    };
    EXPECT_THAT(error({"hall"}), HasSubstr("give --config FILE"));
    EXPECT_THAT(error({"/dev/ttyUSB99"}), HasSubstr("is it plugged in?"));
    EXPECT_THAT(error({"/"}), HasSubstr("neither a serial device, a pipe nor a file"));
    EXPECT_THAT(error({write("x.bin", "x"), "--decoder", "trek"}), HasSubstr("there is no decoder 'trek'"));
    EXPECT_THAT(error({write("x.bin", "x"), "--decoder", "serial_layout"}), HasSubstr("--config FILE"));
    EXPECT_THAT(error({write("x.log", "x")}), HasSubstr("is no recording"));
    EXPECT_THAT(error({write("x.bin", "x"), "--baud", "fast"}), HasSubstr("115200"));
    EXPECT_THAT(error({"can77", "--decoder", "trek1000"}), HasSubstr("does not read"));
}

TEST_F(SniffCommand, NothingIsToldOfNothing) {
    const auto result = sniff({write("empty.bin", "")});
    EXPECT_EQ(result.exit_code, exit_no);
    EXPECT_THAT(result.err, HasSubstr("nothing came"));
}

} // namespace
} // namespace locus
