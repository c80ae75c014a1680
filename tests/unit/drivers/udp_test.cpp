// UDP over the loopback: a packet a datagram, with the kernel's stamp; one remote device or anybody.
#include "drivers/clock.h"
#include "drivers/transport/unique_fd.h"
#include "tests/unit/drivers/transport_fixture.h"

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <sys/socket.h>

#include <thread>

namespace locus {
namespace {

using namespace std::chrono_literals;
using namespace testing_transport;
using testing::HasSubstr;

/// A device at a free port of the loopback.
struct UdpPeer {
    UdpPeer() : fd{::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)} {
        sockaddr_in own = at(0);
        socklen_t size = sizeof own;
        auto* generic = reinterpret_cast<sockaddr*>(&own);
        if (::bind(fd.get(), generic, size) != 0 || ::getsockname(fd.get(), generic, &size) != 0)
            throw std::runtime_error("bind");
        port = ntohs(own.sin_port);
    }
    static sockaddr_in at(std::int64_t port) {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_port = htons(static_cast<std::uint16_t>(port));
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        return address;
    }
    void send(std::int64_t to, std::string_view text) const {
        const sockaddr_in address = at(to);
        ::sendto(fd.get(), text.data(), text.size(), 0, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    }
    std::string receive() const {
        std::string text(100, ' ');
        const ssize_t size = ::recv(fd.get(), text.data(), text.size(), MSG_DONTWAIT);
        return text.substr(0, static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    }

    UniqueFd fd;
    std::int64_t port = 0;
};

std::int64_t free_port() { return UdpPeer{}.port; }

Packet text_packet(std::string_view text) {
    Packet packet;
    packet.data = {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
    return packet;
}

class Udp : public testing::Test {
  protected:
    std::unique_ptr<Transport> transport(Values more = {}) {
        more.insert({{"address", "127.0.0.1"}, {"port", port}});
        return make_transport("udp", more);
    }

    UdpPeer device;
    std::int64_t port = free_port();
    KeepingSink sink;
};

TEST_F(Udp, ADatagramIsAPacketWithTheKernelsStamp) {
    const auto udp = transport();
    ASSERT_TRUE(udp->open()) << udp->last_error();
    std::this_thread::sleep_for(200ms); // the kernel begins to stamp a moment after it was first asked to
    const Timestamp before = monotonic_now();
    device.send(port, "one");
    device.send(port, std::string(1452, 'x'));
    const Timestamp sent = monotonic_now();
    std::this_thread::sleep_for(50ms); // the stamp is the kernel's, not that of reading
    ASSERT_EQ(read_bytes(*udp, sink, 1455), ReadStatus::ok);
    ASSERT_EQ(sink.kept.size(), 2u);
    EXPECT_EQ(sink.kept[0].data.size(), 3u);
    EXPECT_EQ(sink.kept[1].data.size(), 1452u);
    for (const auto& kept : sink.kept) {
        EXPECT_GE(kept.packet.time, before - 1ms);
        EXPECT_LE(kept.packet.time, sent + 1ms);
        EXPECT_EQ(to_ns(kept.packet.time) % 1000, 0);
    }
}

TEST_F(Udp, WithARemoteAddressNobodyElseIsHeardAndItCanBeAsked) {
    const auto udp = transport({{"remote_address", "127.0.0.1"}, {"remote_port", device.port}});
    ASSERT_TRUE(udp->open()) << udp->last_error();
    UdpPeer{}.send(port, "stranger");
    device.send(port, "friend");
    ASSERT_EQ(read_bytes(*udp, sink, 6), ReadStatus::ok);
    EXPECT_EQ(sink.text, "friend");
    ASSERT_TRUE(udp->write(text_packet("range!")));
    EXPECT_EQ(device.receive(), "range!");
}

TEST_F(Udp, WithoutOneThereIsNobodyToAsk) {
    const auto udp = transport();
    ASSERT_TRUE(udp->open());
    EXPECT_FALSE(udp->write(text_packet("range!")));
}

TEST_F(Udp, ADeviceThatIsOffIsATroubleAndNoLoss) {
    const std::int64_t nobody = free_port();
    const auto udp = transport({{"remote_address", "127.0.0.1"}, {"remote_port", nobody}});
    ASSERT_TRUE(udp->open());
    udp->write(text_packet("?"));
    EXPECT_EQ(udp->read(sink, 100ms), ReadStatus::ok);
    EXPECT_THAT(std::string{udp->trouble()}, HasSubstr("127.0.0.1 does not answer"));
}

TEST_F(Udp, ADatagramThatIsTooLongIsLeftOut) {
    const auto udp = transport();
    ASSERT_TRUE(udp->open());
    device.send(port, std::string(4097, 'x'));
    EXPECT_EQ(udp->read(sink, 100ms), ReadStatus::ok);
    EXPECT_TRUE(sink.kept.empty());
    EXPECT_THAT(std::string{udp->trouble()}, HasSubstr("4096"));
    device.send(port, "short");
    EXPECT_EQ(udp->read(sink, 100ms), ReadStatus::ok);
    EXPECT_EQ(sink.text, "short");
    EXPECT_TRUE(udp->trouble().empty());
}

TEST_F(Udp, TheKernelsDropsAreCounted) {
    const auto udp = transport();
    ASSERT_TRUE(udp->open());
    constexpr std::uint64_t sent = 2000; // of 1 kB: more than a socket's buffer holds
    for (std::uint64_t i = 0; i < sent; ++i) device.send(port, std::string(1000, 'x'));
    const auto read_all = [&] {
        std::size_t before = 0;
        do {
            before = sink.kept.size();
            ASSERT_EQ(udp->read(sink, 10ms), ReadStatus::ok);
        } while (sink.kept.size() > before);
    };
    read_all();
    EXPECT_LT(sink.kept.size(), sent);
    device.send(port, "!"); // the count travels with the next datagram
    read_all();
    EXPECT_EQ(sink.kept.size() + udp->kernel_dropped(), sent + 1);
}

TEST_F(Udp, SaysWhatIsInTheWay) {
    const auto says = [&](const Values& values) {
        const auto udp = transport(values);
        EXPECT_FALSE(udp->open());
        return std::string{udp->last_error()};
    };
    EXPECT_THAT(says({{"address", "radio.local"}}), HasSubstr("is no IP address"));
    EXPECT_THAT(says({{"address", "192.0.2.1"}}), HasSubstr("no address of this machine"));
    EXPECT_THAT(says({{"port", device.port}}), HasSubstr("in use"));
    EXPECT_THAT(says({{"remote_address", "radio"}, {"remote_port", std::int64_t{21210}}}), HasSubstr("no IP address"));
}

} // namespace
} // namespace locus
