// TCP client, for serial ports behind ser2net or a device that speaks on a socket. Nagle is off, and keep-alive finds
// a dead peer within about half a minute even when nothing was to be sent.
#include "drivers/transport/rows.h"
#include "drivers/transport/stream.h"

#include <netdb.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>

namespace locus {
namespace {

struct TcpSettings {
    std::string host;
    int port = 0;
    double connect_timeout_s = 0.5;
};

constexpr std::array tcp_options{
    required_option<&TcpSettings::host>(
        "host", "Address of the server; a number is better than a name, whose look-up may block for seconds."),
    option<&TcpSettings::port>("port", "", 1, 65535, "TCP port of the server.", {}, true),
    option<&TcpSettings::connect_timeout_s>("connect_timeout_s", "s", 0.05, 5,
                                            "Longest wait for the connection; the daemon's stop may wait as long."),
};

using Addresses = std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)>;

Addresses look_up(const std::string& host, int port, std::string& error) {
    addrinfo hints{};
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    const int code = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found);
    if (code != 0) error = ::gai_strerror(code);
    return {found, &::freeaddrinfo};
}

/// 0 or the errno of the connection.
int finish_connecting(int fd, int timeout_ms) {
    pollfd waiting{fd, POLLOUT, 0};
    if (::poll(&waiting, 1, timeout_ms) <= 0) return ETIMEDOUT;
    int reason = 0;
    socklen_t size = sizeof reason;
    ::getsockopt(fd, SOL_SOCKET, SO_ERROR, &reason, &size);
    return reason;
}

UniqueFd connect_to(const addrinfo& address, int timeout_ms, int& reason) {
    UniqueFd fd{::socket(address.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, address.ai_protocol)};
    reason = fd && ::connect(fd.get(), address.ai_addr, address.ai_addrlen) == 0 ? 0 : errno;
    if (reason == EINPROGRESS) reason = finish_connecting(fd.get(), timeout_ms);
    return reason == 0 ? std::move(fd) : UniqueFd{};
}

/// A name may stand for several addresses ("localhost": one of IPv6, one of IPv4); the first that answers.
UniqueFd connect_to_any(const addrinfo* address, int timeout_ms, int& reason) {
    UniqueFd fd;
    for (; address && !fd; address = address->ai_next) fd = connect_to(*address, timeout_ms, reason);
    return fd;
}

void set(int fd, int level, int option, int value) { ::setsockopt(fd, level, option, &value, sizeof value); }

void keep_alive(int fd) {
    set(fd, SOL_SOCKET, SO_KEEPALIVE, 1);
    set(fd, IPPROTO_TCP, TCP_KEEPIDLE, 10);
    set(fd, IPPROTO_TCP, TCP_KEEPINTVL, 5);
    set(fd, IPPROTO_TCP, TCP_KEEPCNT, 4);
    set(fd, IPPROTO_TCP, TCP_NODELAY, 1);
}

class Tcp : public StreamTransport {
  public:
    explicit Tcp(const TcpSettings& settings)
        : StreamTransport{settings.host + ":" + std::to_string(settings.port)}, settings_{settings} {}

    bool open() override {
        std::string error;
        const Addresses addresses = look_up(settings_.host, settings_.port, error);
        if (!addresses) return refuse("'" + settings_.host + "' is not known: " + error);
        int reason = 0;
        fd_ = connect_to_any(addresses.get(), static_cast<int>(settings_.connect_timeout_s * 1000), reason);
        if (!fd_) return refuse("no connection to " + device_ + ": " + std::strerror(reason));
        keep_alive(fd_.get());
        return true;
    }

  private:
    const TcpSettings settings_;
};

} // namespace

TransportRow tcp_row() {
    return {"tcp",
            "TCP client, e.g. of ser2net.",
            Wire::bytes,
            true,
            option_table<TcpSettings>(tcp_options),
            [](const void* settings) -> std::unique_ptr<Transport> {
                return std::make_unique<Tcp>(*static_cast<const TcpSettings*>(settings));
            }};
}

} // namespace locus
