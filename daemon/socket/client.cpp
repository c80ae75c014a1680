#include "daemon/socket/client.h"

#include <sys/epoll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>

namespace locus {
namespace {

bool passes(int error) { return error == EAGAIN || error == EWOULDBLOCK || error == EINTR; }

} // namespace

bool Client::receive() {
    if (reader_.has_whole_command()) return true; // answered before more is taken in: the buffer stays bounded
    std::array<char, CommandReader::max_command> bytes;
    const ssize_t got = ::recv(fd_.get(), bytes.data(), bytes.size(), 0);
    if (got < 0) return passes(errno);
    if (got == 0) said_all_ = true; // it may still read, as `echo '?POLL;' | nc -U` does
    reader_.feed({bytes.data(), static_cast<std::size_t>(got)});
    return true;
}

std::optional<ParsedCommand> Client::next_command() {
    if (!is_listened_to()) return {};
    return reader_.next();
}

bool Client::flush() {
    while (!queue.empty()) {
        const auto bytes = queue.front();
        const ssize_t sent = ::send(fd_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent < 0) return passes(errno);
        queue.written(static_cast<std::size_t>(sent));
        if (static_cast<std::size_t>(sent) < bytes.size()) return true;
    }
    return true;
}

std::uint32_t Client::interest() const {
    // Commands left over from this round are asked for again by EPOLLOUT, which is true at once.
    const bool more = is_listened_to() && reader_.has_whole_command();
    const std::uint32_t out = !queue.empty() || more ? std::uint32_t{EPOLLOUT} : 0U;
    const std::uint32_t in = is_listened_to() && !said_all_ ? std::uint32_t{EPOLLIN} : 0U;
    return in | out;
}

bool Client::may_change() const {
    ucred peer{};
    socklen_t size = sizeof peer;
    if (::getsockopt(fd_.get(), SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return false;
    return peer.uid == 0 || peer.uid == ::geteuid();
}

} // namespace locus
