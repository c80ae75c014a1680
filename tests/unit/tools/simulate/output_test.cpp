// Simulated devices as the daemon's own transports see them.
#include "tools/simulate/output.h"

#include "config/load.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <fstream>

namespace locus::simulate {
namespace {

using ::testing::HasSubstr;

struct ReceivedBytes : PacketSink {
    std::string text;
    void packet(const Packet& packet) override {
        text.append(reinterpret_cast<const char*>(packet.data.data()), packet.data.size());
    }
};

class OutputTest : public ::testing::Test {
  protected:
    OutputTest() { std::signal(SIGPIPE, SIG_IGN); } // as the program does: a pipe without a reader is a loss, no end

    test::TemporaryFolder room;

    InputSettings input(const std::string& transport) const {
        InputSettings input;
        input.name = "uwb";
        input.transport = find_transport(transport);
        input.transport_settings = input.transport->options.make();
        for (const OptionRow& row : input.transport->options.rows)
            if (row.name == "path") row.set(input.transport_settings.get(), room / "device");
        return input;
    }

    static void send(Output& output, std::string_view text) {
        Packet packet;
        packet.data = {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
        output.packet(packet);
    }

    static std::string receive(Transport& transport, std::size_t size) {
        ReceivedBytes sink;
        for (int i = 0; i < 100 && sink.text.size() < size; ++i) transport.read(sink, std::chrono::milliseconds{50});
        return sink.text;
    }

    void check_that_only_a_reader_gets_bytes(const std::string& transport_name) {
        const InputSettings settings = input(transport_name);
        const auto output = make_output(settings);
        send(*output, "before anybody listens\n");
        EXPECT_EQ(output->lost(), 1u);
        const auto transport = settings.transport->make(settings.transport_settings.get());
        ASSERT_TRUE(transport->open()) << transport->last_error();
        send(*output, "mc\r\n\x03\x04\n");
        EXPECT_EQ(receive(*transport, 7), "mc\r\n\x03\x04\n");
        transport->close();
        send(*output, "after\n");
        EXPECT_EQ(output->lost(), 2u);
        ASSERT_TRUE(transport->open());
        send(*output, "again\n");
        EXPECT_EQ(receive(*transport, 6), "again\n");
    }
};

TEST_F(OutputTest, APseudoTerminalThatComesAndGoesWithItsReader) { check_that_only_a_reader_gets_bytes("pty"); }

TEST_F(OutputTest, ANamedPipeThatComesAndGoesWithItsReader) { check_that_only_a_reader_gets_bytes("fifo"); }

TEST_F(OutputTest, NobodyWhoDoesNotReadHoldsTheSimulationUp) {
    const InputSettings settings = input("pty");
    const auto output = make_output(settings);
    const auto transport = settings.transport->make(settings.transport_settings.get());
    ASSERT_TRUE(transport->open());
    const std::string line(100, 'x');
    for (int i = 0; i < 10'000; ++i) send(*output, line);
    EXPECT_GT(output->lost(), 0u);
}

TEST_F(OutputTest, TheLinkGoesWithTheDeviceAndReplacesAnOldLinkOnly) {
    const auto link = room / "device";
    std::filesystem::create_symlink("/nowhere", link);
    {
        const auto output = make_output(input("pty"));
        EXPECT_TRUE(std::filesystem::is_character_file(link));
    }
    EXPECT_FALSE(std::filesystem::exists(std::filesystem::symlink_status(link)));
    std::ofstream(link) << "precious";
    EXPECT_THROW(make_output(input("pty")), std::runtime_error);
    EXPECT_THROW(make_output(input("fifo")), std::runtime_error);
    EXPECT_TRUE(std::filesystem::is_regular_file(link));
}

TEST_F(OutputTest, AMissingCanInterfaceIsASentence) {
    InputSettings settings = input("can");
    for (const OptionRow& row : settings.transport->options.rows)
        if (row.name == "interface") row.set(settings.transport_settings.get(), std::string("locus-none"));
    EXPECT_THROW(make_output(settings), std::runtime_error);
}

TEST_F(OutputTest, OnlyDevicesOfItsOwnCanBeSimulated) {
    EXPECT_EQ(cannot_open(input("pty")), "");
    EXPECT_THAT(cannot_open(input("recording")), HasSubstr("use pty, fifo or can"));
}

} // namespace
} // namespace locus::simulate
