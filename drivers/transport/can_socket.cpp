#include "drivers/transport/can_socket.h"

#include "drivers/transport/can_frame.h"

#include <linux/can/raw.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

namespace locus {
namespace {

ifreq request_for(const std::string& interface) {
    ifreq request{};
    interface.copy(request.ifr_name, sizeof request.ifr_name - 1);
    return request;
}

bool is_can(int fd, const std::string& interface) {
    ifreq request = request_for(interface);
    return ::ioctl(fd, SIOCGIFHWADDR, &request) == 0 && request.ifr_hwaddr.sa_family == ARPHRD_CAN;
}

bool has_flag(int fd, const std::string& interface, int flag) {
    ifreq request = request_for(interface);
    return ::ioctl(fd, SIOCGIFFLAGS, &request) == 0 && (request.ifr_flags & flag);
}

/// What stands in the way of receiving; empty when nothing does.
std::string obstacle(int fd, const std::string& interface) {
    if (fd < 0 && errno == EAFNOSUPPORT) return "this kernel has no SocketCAN: try `modprobe can-raw`";
    if (fd < 0) return std::string{"a CAN socket cannot be made: "} + std::strerror(errno);
    if (interface.size() >= IFNAMSIZ || ::if_nametoindex(interface.c_str()) == 0) {
        return "there is no interface '" + interface + "': is the CAN adapter plugged in? `ip -br link` shows what is";
    }
    if (!is_can(fd, interface)) return "'" + interface + "' is no CAN interface";
    if (!has_flag(fd, interface, IFF_UP)) {
        return interface + " is down: `ip link set " + interface + " up` (a real bus wants its bit rate first)";
    }
    if (!has_flag(fd, interface, IFF_RUNNING)) {
        return interface + " is off the bus (bus-off): check bit rate, wiring and termination; `ip link set " +
               interface + " type can restart-ms 100` lets it come back by itself";
    }
    return {};
}

bool enable_fd(int fd) {
    const int on = 1;
    return ::setsockopt(fd, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on) == 0;
}

bool bind_to(int fd, const std::string& interface) {
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(::if_nametoindex(interface.c_str()));
    // Index 0 would mean every interface: the one that was there a moment ago is gone.
    return address.can_ifindex != 0 && ::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
}

} // namespace

bool CanSocket::open(const std::string& interface, std::string& error) {
    fd_.reset(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW));
    error = obstacle(fd_.get(), interface);
    if (error.empty() && (!enable_fd(fd_.get()) || !bind_to(fd_.get(), interface))) {
        error = interface + " cannot be opened: " + std::strerror(errno);
    }
    if (!error.empty()) close();
    return error.empty();
}

bool CanSocket::send(const Packet& packet) const {
    const auto out = can_from_packet(packet);
    for (int tries = 0; out && tries < 100; ++tries) {
        if (::write(fd_.get(), &out->frame, out->size) == static_cast<ssize_t>(out->size)) return true;
        if (errno != ENOBUFS && errno != EAGAIN) return false;
        std::this_thread::sleep_for(std::chrono::milliseconds{1}); // a full queue wakes nobody
    }
    return false;
}

} // namespace locus
