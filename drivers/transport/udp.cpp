// UDP: one packet a datagram, stamped by the kernel. With a `remote_address` it hears and answers that one device only.
#include "drivers/clock.h"
#include "drivers/transport/receive_stamps.h"
#include "drivers/transport/rows.h"
#include "drivers/transport/unique_fd.h"

#include <linux/net_tstamp.h>
#include <netdb.h>
#include <poll.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace locus {
namespace {

struct UdpSettings {
    std::string address = "0.0.0.0";
    int port = 0;
    std::string remote_address{};
    int remote_port = 0;
};

constexpr std::array udp_options{
    option<&UdpSettings::address>("address", "Own address to receive at, as a number; 0.0.0.0 or ::: every one."),
    option<&UdpSettings::port>("port", "", 1, 65535, "Own UDP port to receive at.", {}, true),
    option<&UdpSettings::remote_address>("remote_address", "Address of the device, as a number: then nobody else is "
                                                           "heard, and the device can be asked; empty: anybody."),
    option<&UdpSettings::remote_port>("remote_port", "", 0, 65535, "UDP port of the device, with remote_address."),
};

constexpr std::size_t longest_datagram = 4096; // what a line of a recording holds
constexpr int datagrams_at_once = 64;          // then the input's thread looks whether it should stop

using Addresses = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

/// Numbers only: looking up a name may block for seconds.
Addresses numeric(const std::string& address, int port) {
    addrinfo hints{};
    hints.ai_socktype = SOCK_DGRAM;
    hints.ai_flags = AI_NUMERICHOST | AI_NUMERICSERV;
    addrinfo* found = nullptr;
    const int failed = ::getaddrinfo(address.c_str(), std::to_string(port).c_str(), &hints, &found);
    return {failed ? nullptr : found, &::freeaddrinfo};
}

std::string check_udp(const void* pointer) {
    const auto& settings = *static_cast<const UdpSettings*>(pointer);
    for (const std::string& address : {settings.address, settings.remote_address})
        if (!address.empty() && !numeric(address, 1)) return "'" + address + "' is no IP address";
    const bool half = settings.remote_address.empty() != (settings.remote_port == 0);
    return half ? "remote_address and remote_port go together" : "";
}

template <class Value>
void set_option(int fd, int option, const Value& value) {
    ::setsockopt(fd, SOL_SOCKET, option, &value, sizeof value);
}

class Udp : public Transport {
  public:
    explicit Udp(const UdpSettings& settings)
        : settings_{settings}, name_{settings.address + ":" + std::to_string(settings.port)} {}

    bool open() override {
        trouble_.clear();
        drops_.reset();
        const Addresses own = numeric(settings_.address, settings_.port);
        if (!own) return refuse("'" + settings_.address + "' is no IP address");
        fd_.reset(::socket(own->ai_family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
        if (!fd_) return refuse(std::string{"no UDP socket can be made: "} + std::strerror(errno));
        set_option(fd_.get(), SO_TIMESTAMPING, SOF_TIMESTAMPING_SOFTWARE | SOF_TIMESTAMPING_RX_SOFTWARE);
        set_option(fd_.get(), SO_RXQ_OVFL, 1);
        if (::bind(fd_.get(), own->ai_addr, own->ai_addrlen) != 0) return refuse(bind_sentence(errno));
        return settings_.remote_address.empty() || connect();
    }

    void close() override { fd_.reset(); }

    ReadStatus read(PacketSink& sink, Duration timeout) override {
        pollfd waiting{fd_.get(), POLLIN, 0};
        const auto timeout_ms = std::chrono::ceil<std::chrono::milliseconds>(timeout).count();
        if (::poll(&waiting, 1, static_cast<int>(timeout_ms)) <= 0) return ReadStatus::ok;
        for (int i = 0; i < datagrams_at_once && receive(sink); ++i) continue;
        return ReadStatus::ok;
    }

    bool write(const Packet& packet) override {
        if (settings_.remote_address.empty()) return false;
        return ::send(fd_.get(), packet.data.data(), packet.data.size(), MSG_NOSIGNAL) == std::ssize(packet.data);
    }

    std::uint64_t kernel_dropped() const override { return drops_.total(); }
    std::string_view trouble() const override { return trouble_; }
    std::string_view last_error() const override { return error_; }

  private:
    bool connect() {
        const Addresses remote = numeric(settings_.remote_address, settings_.remote_port);
        if (!remote) return refuse("'" + settings_.remote_address + "' is no IP address");
        if (::connect(fd_.get(), remote->ai_addr, remote->ai_addrlen) == 0) return true;
        return refuse("there is no way to " + settings_.remote_address + ": " + std::strerror(errno));
    }

    std::string bind_sentence(int reason) const {
        if (reason == EADDRINUSE) return "UDP port " + name_ + " is in use by another program: `ss -lup` says which";
        if (reason == EADDRNOTAVAIL)
            return settings_.address + " is no address of this machine (yet?): see `ip address`";
        return "UDP port " + name_ + " cannot be opened: " + std::strerror(reason);
    }

    bool refuse(std::string sentence) {
        error_ = std::move(sentence);
        fd_.reset();
        return false;
    }

    /// False when there is nothing more, for now.
    bool receive(PacketSink& sink) {
        std::array<std::uint8_t, longest_datagram> bytes; // not cleared: recvmsg() says how much of it is filled
        alignas(cmsghdr) std::array<std::byte, 256> control;
        iovec vector{bytes.data(), bytes.size()};
        msghdr message{};
        message.msg_iov = &vector;
        message.msg_iovlen = 1;
        message.msg_control = control.data();
        message.msg_controllen = control.size();
        const ssize_t size = ::recvmsg(fd_.get(), &message, MSG_DONTWAIT);
        if (size < 0) return told(errno);
        hand_over(std::span{bytes}.first(static_cast<std::size_t>(size)), message, sink);
        return true;
    }

    void hand_over(std::span<const std::uint8_t> bytes, const msghdr& message, PacketSink& sink) {
        const ControlData control = read_control(message);
        drops_.take(control);
        if (message.msg_flags & MSG_TRUNC) {
            trouble_ = "a datagram of more than 4096 bytes was left out";
            return;
        }
        trouble_.clear();
        Packet packet;
        packet.data = bytes;
        packet.time = receive_stamp(kernel_time(control, realtime_offset(), monotonic_now()));
        sink.packet(packet);
    }

    /// An unreachable device is no loss of ours: it may be switched on later.
    bool told(int reason) {
        if (reason == EAGAIN || reason == EINTR) return false;
        trouble_ = settings_.remote_address + " does not answer: " + std::strerror(reason);
        return false;
    }

    const UdpSettings settings_;
    const std::string name_;
    UniqueFd fd_;
    KernelDrops drops_;
    std::string trouble_;
    std::string error_;
};

} // namespace

TransportRow udp_row() {
    return {"udp",
            "UDP datagrams, each a packet.",
            Wire::bytes,
            true,
            option_table<UdpSettings>(udp_options, {}, check_udp),
            [](const void* settings) -> std::unique_ptr<Transport> {
                return std::make_unique<Udp>(*static_cast<const UdpSettings*>(settings));
            }};
}

} // namespace locus
