// The byte transports on real pseudo-terminals, pipes and sockets of this machine: bytes through, ends lost, errors
// told.
#include "drivers/clock.h"
#include "drivers/input.h"
#include "drivers/transport/unique_fd.h"
#include "tests/unit/drivers/transport_fixture.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <gmock/gmock.h>
#include <pty.h>
#include <sys/socket.h>
#include <sys/stat.h>

#include <thread>

namespace locus {
namespace {

using namespace testing_transport;
using namespace std::chrono_literals;
using testing::HasSubstr;

/// The simulator's end of a pseudo-terminal, with a link to the daemon's end.
Packet packet_of(std::string_view text) {
    Packet packet;
    packet.data = {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
    return packet;
}

struct SimulatedDevice {
    explicit SimulatedDevice(const std::string& link) {
        int master_fd = -1, slave_fd = -1;
        if (::openpty(&master_fd, &slave_fd, nullptr, nullptr, nullptr) != 0) throw std::runtime_error("openpty");
        master.reset(master_fd);
        const std::string name = ::ttyname(slave_fd);
        ::close(slave_fd);
        std::filesystem::remove(link);
        std::filesystem::create_symlink(name, link);
    }
    void send(std::string_view text) const {
        if (::write(master.get(), text.data(), text.size()) != ssize_t(text.size())) throw std::runtime_error("write");
    }
    UniqueFd master;
};

TEST(Pty, BytesPassUntouchedBothWays) {
    test::TemporaryFolder folder;
    SimulatedDevice device{folder / "uwb"};
    const auto pty = make_transport("pty", {{"path", folder / "uwb"}});
    ASSERT_TRUE(pty->open()) << pty->last_error();
    KeepingSink sink;
    const std::string wire{"mc 0f\r\n\x03\x04\x11\x13\x00\xff", 13};
    const Timestamp before = monotonic_now();
    device.send(wire);
    ASSERT_EQ(read_bytes(*pty, sink, wire.size()), ReadStatus::ok);
    EXPECT_EQ(sink.text, wire);
    EXPECT_GE(sink.kept.front().packet.time, receive_stamp(before));
    EXPECT_LE(sink.kept.back().packet.time, monotonic_now());

    ASSERT_TRUE(pty->write(packet_of({"d\n\0", 3})));
    char echo[8];
    EXPECT_EQ(::read(device.master.get(), echo, sizeof echo), 3);
    EXPECT_EQ(std::string(echo, 3), std::string("d\n\0", 3));
}

TEST(Pty, SilenceIsNoLoss) {
    test::TemporaryFolder folder;
    SimulatedDevice device{folder / "uwb"};
    const auto pty = make_transport("pty", {{"path", folder / "uwb"}});
    ASSERT_TRUE(pty->open());
    KeepingSink sink;
    EXPECT_EQ(pty->read(sink, 1ms), ReadStatus::ok);
    EXPECT_TRUE(sink.kept.empty());
}

TEST(Pty, ALongChunkComesInShortPackets) {
    test::TemporaryFolder folder;
    SimulatedDevice device{folder / "uwb"};
    const auto pty = make_transport("pty", {{"path", folder / "uwb"}});
    ASSERT_TRUE(pty->open());
    std::string wire;
    for (int i = 0; i < 1000; ++i) wire += char(i % 251);
    device.send(wire);
    KeepingSink sink;
    ASSERT_EQ(read_bytes(*pty, sink, wire.size()), ReadStatus::ok);
    EXPECT_EQ(sink.text, wire);
    for (const auto& kept : sink.kept) EXPECT_LE(kept.data.size(), 128u);
}

TEST(Pty, IsForOneReader) {
    test::TemporaryFolder folder;
    SimulatedDevice device{folder / "uwb"};
    const auto pty = make_transport("pty", {{"path", folder / "uwb"}});
    const auto other = make_transport("pty", {{"path", folder / "uwb"}});
    ASSERT_TRUE(pty->open());
    EXPECT_FALSE(other->open());
    EXPECT_THAT(std::string{other->last_error()}, HasSubstr("in use by another program"));
    pty->close();
    EXPECT_TRUE(other->open()) << other->last_error();
}

TEST(Pty, ClosedMasterIsALossAndTheLinkIsFollowedAnew) {
    test::TemporaryFolder folder;
    auto device = std::make_unique<SimulatedDevice>(folder / "uwb");
    const auto pty = make_transport("pty", {{"path", folder / "uwb"}});
    ASSERT_TRUE(pty->open());
    device.reset();
    KeepingSink sink;
    ASSERT_EQ(read_until_lost(*pty, sink), ReadStatus::lost);
    EXPECT_THAT(std::string{pty->last_error()}, HasSubstr("is gone"));
    pty->close();
    EXPECT_FALSE(pty->open());
    EXPECT_THAT(std::string{pty->last_error()}, HasSubstr("is not there"));

    device = std::make_unique<SimulatedDevice>(folder / "uwb");
    ASSERT_TRUE(pty->open()) << pty->last_error();
    device->send("again");
    ASSERT_EQ(read_bytes(*pty, sink, 5), ReadStatus::ok);
    EXPECT_EQ(sink.text, "again");
}

TEST(Pty, AnInputSurvivesItsDevice) {
    test::TemporaryFolder folder;
    auto device = std::make_unique<SimulatedDevice>(folder / "uwb");
    KeepingSink tap;
    Input input{{.name = "uwb", .transport = make_transport("pty", {{"path", folder / "uwb"}}), .tap = &tap}};
    std::jthread thread{[&](std::stop_token stop) { input.run(stop); }};
    const auto wait_for = [&](std::uint64_t bytes) {
        for (int i = 0; i < 500 && input.status().bytes < bytes; ++i) std::this_thread::sleep_for(10ms);
        return input.status().bytes.load();
    };
    device->send("one");
    EXPECT_EQ(wait_for(3), 3u);
    device.reset();
    device = std::make_unique<SimulatedDevice>(folder / "uwb");
    device->send("two");
    EXPECT_EQ(wait_for(6), 6u);
    thread.request_stop();
    thread.join();
    EXPECT_EQ(tap.text, "onetwo");
    EXPECT_EQ(input.status().reconnects, 1u);
}

TEST(Pty, RefusesWhatIsNone) {
    test::TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    const auto pty = make_transport("pty", {{"path", folder / "pipe"}});
    EXPECT_FALSE(pty->open());
    EXPECT_THAT(std::string{pty->last_error()}, HasSubstr("transport: fifo"));
}

TEST(Fifo, WritersComeAndGo) {
    test::TemporaryFolder folder;
    const std::string path = folder / "pipe";
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    const auto fifo = make_transport("fifo", {{"path", path}});
    ASSERT_TRUE(fifo->open()) << fifo->last_error();
    KeepingSink sink;
    for (const std::string text : {"first ", "second"}) {
        UniqueFd writer{::open(path.c_str(), O_WRONLY)};
        ASSERT_EQ(::write(writer.get(), text.data(), text.size()), ssize_t(text.size()));
        writer.reset();
        ASSERT_EQ(read_bytes(*fifo, sink, sink.text.size() + text.size()), ReadStatus::ok);
        EXPECT_EQ(fifo->read(sink, 1ms), ReadStatus::ok) << "no writer is no loss";
    }
    EXPECT_EQ(sink.text, "first second");
}

TEST(Fifo, RefusesAFile) {
    test::TemporaryFolder folder;
    UniqueFd file{::open((folder / "file").c_str(), O_CREAT | O_WRONLY, 0600)};
    const auto fifo = make_transport("fifo", {{"path", folder / "file"}});
    EXPECT_FALSE(fifo->open());
    EXPECT_THAT(std::string{fifo->last_error()}, HasSubstr("not a named pipe"));
}

TEST(Serial, SendsPseudoTerminalsToTheirTransport) {
    test::TemporaryFolder folder;
    SimulatedDevice device{folder / "uwb"};
    const auto serial = make_transport("serial", {{"path", folder / "uwb"}});
    EXPECT_FALSE(serial->open());
    EXPECT_THAT(std::string{serial->last_error()}, HasSubstr("use transport: pty"));
}

TEST(Serial, SaysWhatIsMissing) {
    const auto serial = make_transport("serial", {{"path", "/dev/serial/by-id/none"}});
    EXPECT_FALSE(serial->open());
    EXPECT_THAT(std::string{serial->last_error()}, HasSubstr("is not there"));
    const auto other = make_transport("serial", {{"path", "/dev/null"}});
    EXPECT_FALSE(other->open());
    EXPECT_THAT(std::string{other->last_error()}, HasSubstr("no serial port"));
}

/// A server on a free port of the loopback.
struct Server {
    Server() : listener{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)} {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        auto* generic = reinterpret_cast<sockaddr*>(&address);
        if (::bind(listener.get(), generic, size) != 0 || ::listen(listener.get(), 1) != 0 ||
            ::getsockname(listener.get(), generic, &size) != 0) {
            throw std::runtime_error("listen");
        }
        port = ntohs(address.sin_port);
    }
    UniqueFd accept() const { return UniqueFd{::accept(listener.get(), nullptr, nullptr)}; }

    UniqueFd listener;
    std::int64_t port = 0;
};

TEST(Tcp, BytesPassAndTheServersEndIsALoss) {
    Server server;
    const auto tcp = make_transport("tcp", {{"host", "127.0.0.1"}, {"port", server.port}});
    for (int round = 0; round < 2; ++round) {
        ASSERT_TRUE(tcp->open()) << tcp->last_error();
        UniqueFd peer = server.accept();
        KeepingSink sink;
        ASSERT_EQ(::write(peer.get(), "hello", 5), 5);
        ASSERT_EQ(read_bytes(*tcp, sink, 5), ReadStatus::ok);
        EXPECT_EQ(sink.text, "hello");
        ASSERT_TRUE(tcp->write(packet_of("?")));
        char asked = 0;
        EXPECT_EQ(::read(peer.get(), &asked, 1), 1);
        EXPECT_EQ(asked, '?');
        peer.reset();
        EXPECT_EQ(read_until_lost(*tcp, sink), ReadStatus::lost);
        tcp->close();
    }
}

TEST(Tcp, SaysWhyThereIsNoConnection) {
    std::int64_t port = Server{}.port; // nobody listens there any more
    const auto tcp = make_transport("tcp", {{"host", "127.0.0.1"}, {"port", port}});
    EXPECT_FALSE(tcp->open());
    EXPECT_THAT(std::string{tcp->last_error()}, HasSubstr("Connection refused"));
}

TEST(TransportTable, NamesAreOwnAndOnlyTcpAndUdpNeedTheNetwork) {
    for (const TransportRow& row : transport_table()) {
        EXPECT_EQ(find_transport(row.name), &row);
        EXPECT_EQ(row.needs_network, row.name == "tcp" || row.name == "udp") << row.name;
    }
    EXPECT_EQ(find_transport("carrier pigeon"), nullptr);
}

} // namespace
} // namespace locus
