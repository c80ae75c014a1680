#include "daemon/socket/listener.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <systemd/sd-daemon.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace locus {
namespace {

constexpr mode_t socket_mode = 0660;

std::runtime_error failure(const std::string& path, const char* what) {
    const char* hint = errno == EACCES || errno == EROFS ? "; is the folder writable for this user?"
                       : errno == ENOENT                 ? "; the folder must exist"
                                                         : "";
    return std::runtime_error(fmt::format("{}: {}: {}{}", path, what, std::strerror(errno), hint));
}

sockaddr_un address_of(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.empty() || path.size() >= sizeof address.sun_path)
        throw std::runtime_error(fmt::format("{}: a socket's path has 1 to {} characters; set publish.socket", path,
                                             sizeof address.sun_path - 1));
    std::ranges::copy(path, address.sun_path);
    return address;
}

UniqueFd stream_socket() { return UniqueFd{::socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)}; }

const sockaddr* generic(const sockaddr_un& address) { return reinterpret_cast<const sockaddr*>(&address); }

/// A daemon that was killed leaves its file behind; one that runs is found by calling at it.
void remove_stale(const std::string& path, const sockaddr_un& address) {
    struct stat status{};
    if (::lstat(path.c_str(), &status) != 0) return;
    if (!S_ISSOCK(status.st_mode))
        throw std::runtime_error(path + ": is there already and is not a socket; remove it or set publish.socket");
    const UniqueFd caller = stream_socket();
    if (::connect(caller.get(), generic(address), sizeof address) == 0 || errno == EAGAIN)
        throw std::runtime_error(path + ": another locusd listens there already; stop it or set publish.socket");
    ::unlink(path.c_str());
}

} // namespace

Listener::Listener(UniqueFd fd, std::string path) : fd_{std::move(fd)}, path_{std::move(path)} {}

Listener::Listener(Listener&& other) noexcept
    : fd_{std::move(other.fd_)}, path_{std::exchange(other.path_, std::string{})} {}

Listener::~Listener() {
    if (!path_.empty()) ::unlink(path_.c_str());
}

Listener Listener::bind(const std::string& path) {
    const sockaddr_un address = address_of(path);
    remove_stale(path, address);
    UniqueFd fd = stream_socket();
    if (::bind(fd.get(), generic(address), sizeof address) != 0) throw failure(path, "cannot make the socket");
    Listener listener{std::move(fd), path};
    // Between bind and chmod nobody can connect: it does not listen yet.
    if (::chmod(path.c_str(), socket_mode) != 0) throw failure(path, "cannot set its mode");
    if (::listen(listener.fd(), SOMAXCONN) != 0) throw failure(path, "cannot listen");
    return listener;
}

std::optional<Listener> Listener::inherit() {
    const int count = ::sd_listen_fds(1);
    if (count <= 0) return {};
    if (count > 1 || ::sd_is_socket(SD_LISTEN_FDS_START, AF_UNIX, SOCK_STREAM, 1) <= 0)
        throw std::runtime_error("systemd handed over something else than one listening UNIX stream socket");
    // systemd hands it over blocking, and an accept that waits would stop every client.
    ::fcntl(SD_LISTEN_FDS_START, F_SETFL, ::fcntl(SD_LISTEN_FDS_START, F_GETFL) | O_NONBLOCK);
    return Listener{UniqueFd{SD_LISTEN_FDS_START}, {}};
}

} // namespace locus
