#include "drivers/transport/stream.h"

#include "drivers/clock.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/file.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

namespace locus {
namespace {

constexpr int write_timeout_ms = 200;

int to_ms(Duration duration) {
    return static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(duration).count());
}

std::string open_sentence(const std::string& path, std::string_view kind, int reason) {
    const std::string device = "'" + path + "'";
    const std::string wanted{kind};
    switch (reason) {
    case ENOENT:
    case ENODEV:
    case ENXIO:
        return device + " is not there: is the " + wanted + " plugged in or its program running?";
    case EACCES:
    case EPERM:
        return "no permission to read and write " + device + ": see `ls -l` and the groups of this user";
    case EBUSY:
        return in_use_sentence(path);
    default:
        return device + " cannot be opened: " + std::strerror(reason);
    }
}

} // namespace

ReadStatus StreamTransport::read(PacketSink& sink, Duration timeout) {
    pollfd waiting{fd_.get(), POLLIN, 0};
    const int ready = ::poll(&waiting, 1, to_ms(timeout));
    const Timestamp woken = monotonic_now();
    if (ready <= 0) return ready == 0 || errno == EINTR ? ReadStatus::ok : lost(std::strerror(errno));
    if (waiting.revents & POLLIN) return take(sink, woken);
    return lost("the other end hung up or it was unplugged");
}

ReadStatus StreamTransport::take(PacketSink& sink, Timestamp woken) {
    std::array<std::uint8_t, 4096> chunk; // not cleared: read() says how much of it is filled
    const ssize_t size = ::read(fd_.get(), chunk.data(), chunk.size());
    if (size == 0) return lost("the other end closed it or it was unplugged");
    if (size < 0) return errno == EAGAIN || errno == EINTR ? ReadStatus::ok : lost(std::strerror(errno));
    hand_over(std::span{chunk}.first(static_cast<std::size_t>(size)), woken, sink);
    return ReadStatus::ok;
}

/// Each packet is stamped with the time of its own last byte.
void StreamTransport::hand_over(std::span<const std::uint8_t> bytes, Timestamp woken, PacketSink& sink) const {
    while (!bytes.empty()) {
        Packet packet;
        packet.data = bytes.first(std::min(bytes.size(), max_packet));
        bytes = bytes.subspan(packet.data.size());
        packet.time = receive_stamp(woken - static_cast<std::int64_t>(bytes.size()) * byte_time_);
        packet.byte_time = byte_time_;
        sink.packet(packet);
    }
}

bool StreamTransport::write(const Packet& packet) {
    auto bytes = packet.data;
    while (!bytes.empty()) {
        const ssize_t size = ::write(fd_.get(), bytes.data(), bytes.size());
        if (size > 0) {
            bytes = bytes.subspan(static_cast<std::size_t>(size));
            continue;
        }
        pollfd waiting{fd_.get(), POLLOUT, 0};
        if (size < 0 && errno != EAGAIN && errno != EINTR) return false;
        if (::poll(&waiting, 1, write_timeout_ms) <= 0) return false;
    }
    return true;
}

bool StreamTransport::refuse(std::string sentence) {
    error_ = std::move(sentence);
    return false;
}

ReadStatus StreamTransport::lost(std::string_view how) {
    error_ = "'" + device_ + "' is gone: " + std::string{how};
    return ReadStatus::lost;
}

bool lock_device(int fd) { return ::flock(fd, LOCK_EX | LOCK_NB) == 0; }

std::string in_use_sentence(const std::string& path) {
    return "'" + path + "' is in use by another program, maybe a running locusd: `fuser -v " + path + "` says which";
}

UniqueFd open_device(const std::string& path, std::string_view kind, std::string& error) {
    UniqueFd fd{::open(path.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC)};
    if (!fd) {
        error = open_sentence(path, kind, errno);
    } else if (!lock_device(fd.get())) {
        error = in_use_sentence(path);
        fd.reset();
    }
    return fd;
}

} // namespace locus
