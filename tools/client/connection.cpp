#include "tools/client/connection.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>

#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/un.h>

namespace locus::tools {

namespace {

constexpr timeval send_patience{5, 0};

std::string why_not_connected(const std::string& path, int error) {
    switch (error) {
    case EACCES:
    case EPERM:
        return fmt::format("{} may not be opened: you are not in group locusd. Run `sudo usermod -aG locusd $USER` "
                           "and log in again, or use sudo",
                           path);
    case ENOENT:
    case ECONNREFUSED:
        return fmt::format("locusd is not running (nothing listens at {}): start it with `sudo systemctl start "
                           "locusd`, or name its socket with --socket or LOCUS_SOCKET",
                           path);
    case EAGAIN:
        return fmt::format("locusd does not take new clients at {}: see `systemctl status locusd`", path);
    default:
        return fmt::format("{} cannot be opened: {}", path, std::strerror(error));
    }
}

// connect() says "refused" of a plain file, which would send the reader looking for a daemon.
void refuse_what_is_no_socket(const std::string& path) {
    struct stat status{};
    if (::stat(path.c_str(), &status) == 0 && !S_ISSOCK(status.st_mode))
        throw DaemonError(fmt::format("{} is not a socket: give the path of locusd's socket with --socket", path));
}

sockaddr_un socket_address(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.empty() || path.size() >= sizeof address.sun_path)
        throw DaemonError(
            fmt::format("\"{}\" cannot be a socket: a path has 1 to {} characters", path, sizeof address.sun_path - 1));
    path.copy(address.sun_path, path.size());
    return address;
}

} // namespace

Connection::Connection(std::string path) : path_(std::move(path)) {
    const sockaddr_un address = socket_address(path_);
    refuse_what_is_no_socket(path_);
    fd_.reset(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    ::setsockopt(fd_.get(), SOL_SOCKET, SO_SNDTIMEO, &send_patience, sizeof send_patience);
    if (::connect(fd_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
        throw DaemonError(why_not_connected(path_, errno));
}

void Connection::send(std::string_view text) {
    while (!text.empty()) {
        const ssize_t sent = ::send(fd_.get(), text.data(), text.size(), MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent < 0)
            throw ConnectionLost(fmt::format("locusd at {} takes no command: {}", path_, std::strerror(errno)));
        text.remove_prefix(static_cast<std::size_t>(sent));
    }
}

std::optional<std::string> Connection::read_line(Deadline deadline) {
    while (true) {
        if (auto line = take_line()) return line;
        if (!wait_readable(deadline)) return std::nullopt;
        fill();
    }
}

std::optional<std::string> Connection::take_line() {
    const std::size_t end = buffer_.find('\n', scanned_);
    scanned_ = buffer_.size();
    if (end == std::string::npos) return std::nullopt;
    std::string line = buffer_.substr(begin_, end - begin_);
    begin_ = scanned_ = end + 1;
    return line;
}

bool Connection::wait_readable(Deadline deadline) const {
    using std::chrono::milliseconds, std::chrono::steady_clock;
    do {
        const auto left = std::chrono::ceil<milliseconds>(deadline - steady_clock::now());
        pollfd poll{fd_.get(), POLLIN, 0};
        const auto patience = std::clamp(left, milliseconds{0}, milliseconds{60'000});
        if (::poll(&poll, 1, static_cast<int>(patience.count())) > 0) return true;
    } while (steady_clock::now() < deadline);
    return false;
}

void Connection::fill() {
    buffer_.erase(0, begin_);
    scanned_ -= begin_;
    begin_ = 0;
    if (buffer_.size() > max_line_bytes)
        throw DaemonError(
            fmt::format("{} sends a line of more than {} bytes: it is not locusd", path_, max_line_bytes));
    std::array<char, 65536> chunk;
    const ssize_t got = ::recv(fd_.get(), chunk.data(), chunk.size(), 0);
    if (got < 0 && errno == EINTR) return;
    if (got < 0) throw ConnectionLost(fmt::format("the connection to locusd broke: {}", std::strerror(errno)));
    if (got == 0) throw ConnectionLost("locusd closed the connection: see `systemctl status locusd`");
    buffer_.append(chunk.data(), static_cast<std::size_t>(got));
}

} // namespace locus::tools
